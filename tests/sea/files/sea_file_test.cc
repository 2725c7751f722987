#include "sea/files/sea_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <string>

#include "sea/files/text_lines.h"
#include "sea/sea_time.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kBuoyEnergy =
    "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >\n"
    "2020 06 08 03 50 0.225 0.218 (0.100) 0.641 (0.200) 0.100 (0.400)\n";
const std::string kBuoySpread =
    "#YY  MM DD hh mm r2_1 (freq_1) r2_2 (freq_2) r2_3 (freq_3) ... >\n"
    "2020 06 08 03 50 0.33 (0.100) 0.50 (0.200) 0.20 (0.400)\n";
const std::string kBuoyDirection =
    "#YY  MM DD hh mm alpha2_1 (freq_1) alpha2_2 (freq_2) alpha2_3 (freq_3) ... >\n"
    "2020 06 08 03 50 30.0 (0.100) 90.0 (0.200) 120.0 (0.400)\n";
const std::string kHistory = "#YY  MM DD hh mm  .0500  .1000  .2000\n2019 02 06 00 40 ";

class SeaFile : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    return folder_.Write(name, text);
  }

  static std::string ErrorOf(const std::filesystem::path& path) {
    return std::string(ReadSeaFile(path).status().message());
  }

  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(SeaFile, TakesSpreadAndDirectionFromTheFilesBesideIt) {
  const auto path = Write("41010.data_spec", kBuoyEnergy);
  EXPECT_THAT(ReadSeaFile(path)->assumed, Contains(HasSubstr("no r2 or alpha2")));
  Write("41010.swr2", kBuoySpread);
  Write("41010.swdir2", kBuoyDirection);
  const auto series = ReadSeaFile(path);
  EXPECT_THAT(series->assumed, Not(Contains(HasSubstr("no r2 or alpha2"))));
  EXPECT_NEAR(std::get<BinnedWaves>(series->records[0].waves)->bin(1).cosine[0], -0.641 * 0.5, 1e-12);
  Write("41010.swr2", kBuoySpread.substr(0, 100));
  EXPECT_THAT(ErrorOf(path), ::testing::StartsWith("beside it, 41010.swr2: its last line, 2, has no end"));
}

TEST_F(SeaFile, FindsTheHistoryByTheLetterBeforeTheYear) {
  const auto path = Write("wdijkw2019part.txt", kHistory + "0.00 1.00 2.00\n");
  const auto spread = Write("wdijkk2019part.txt", kHistory + "94 50 40\n");
  Write("wdijki2019part.txt", kHistory + "146 0 30\n");
  const auto series = ReadSeaFile(path);
  EXPECT_NEAR(std::get<BinnedWaves>(series->records[0].waves)->bin(1).cosine[0], 0.5, 1e-12);
  EXPECT_THAT(ErrorOf(spread), HasSubstr("give the file of energy, wdijkw2019part.txt"));
}

TEST_F(SeaFile, IsKnownByItsFirstLine) {
  EXPECT_TRUE(ReadSeaFile(Write("sea", "# made by hand\n\nf,E\n0.1,1\n0.2,2\n")).ok());
  EXPECT_TRUE(ReadSeaFile(Write("marked", "\xEF\xBB\xBF" + kBuoyEnergy)).ok());
  EXPECT_EQ(ErrorOf(Write("wide", std::string("\xFF\xFE#\0Y\0", 6))), "is UTF-16 text; save it as UTF-8");
  EXPECT_THAT(ErrorOf(Write("a", "Some other text\n")), HasSubstr("begins with 'Some other text' (expected a file of"));
  EXPECT_EQ(ErrorOf(Write("b", "")), "is empty; get another copy of the file");
  EXPECT_THAT(ErrorOf(Write("c", "CDF\x01...")), HasSubstr("is a NetCDF file"));
  EXPECT_THAT(ErrorOf(Write("d", "\x89HDF\r\n")), HasSubstr("is a NetCDF file"));
  EXPECT_THAT(ErrorOf(folder_.path() / "absent"), HasSubstr("does not exist"));
  EXPECT_THAT(ErrorOf(folder_.path()), HasSubstr("not a regular file"));
}

// Files of real stations and models, where they lie beside the checkout.
class RealSea : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kSamples)) {
      GTEST_SKIP() << "no sample files in " << kSamples;
    }
  }

  static absl::StatusOr<SeaSeries> Read(const std::string& name) { return ReadSeaFile(kSamples / name); }

  static const inline std::filesystem::path kSamples = SEA_SAMPLES;
};

// WVHT of the station's own summary, which is 4 sqrt(m0) rounded to 0.1 m: rms 0.029 m from rounding alone. It is dated
// ten minutes before the spectra.
TEST_F(RealSea, HasTheHeightsThatTheStationStates) {
  const auto series = Read("41010.data_spec");
  std::map<double, double> stated;
  std::ifstream summary(kSamples / "41010.spec");
  for (std::string line; std::getline(summary, line);) {
    const auto words = Words(line);
    if (words[0].starts_with('#') || words[5] == "MM") continue;
    const auto at = [&](std::size_t i) { return *ParseCount(words[i]); };
    stated[*SecondsOf({.year = at(0), .month = at(1), .day = at(2), .hour = at(3), .minute = at(4)}) + 600] =
        *ParseNumber(words[5]);
  }
  double squares = 0, worst = 0;
  int compared = 0;
  for (const SeaRecord& record : series->records) {
    const auto found = stated.find(*record.time);
    if (found == stated.end()) continue;
    const double difference = record.significant_wave_height() - found->second;
    squares += difference * difference;
    worst = std::max(worst, std::abs(difference));
    ++compared;
  }
  ASSERT_GT(compared, 140);
  RecordProperty("rms_mm", static_cast<int>(1000 * std::sqrt(squares / compared)));
  RecordProperty("worst_mm", static_cast<int>(1000 * worst));
  EXPECT_LT(std::sqrt(squares / compared), 0.05);
  EXPECT_LT(worst, 0.15);
}

TEST_F(RealSea, IsDirectionalInRealTimeAndInTheHistory) {
  for (const char* name : {"41010.data_spec", "41010w2019part.txt.gz"}) {
    const auto series = Read(name);
    EXPECT_GE(series->records.size(), 99u);
    EXPECT_THAT(series->assumed, Not(Contains(HasSubstr("no r2 or alpha2"))));
    for (const SeaRecord& record : series->records) {
      // Waves of the peak are more or less of one direction: r2 in hundredths would be above 1.
      const BinnedSpectrum& bins = *std::get<BinnedWaves>(record.waves);
      std::size_t peak = 0;
      for (std::size_t i = 1; i < bins.size(); ++i)
        if (bins.bin(i).energy > bins.bin(peak).energy) peak = i;
      const double r2 = std::hypot(bins.bin(peak).cosine[0], bins.bin(peak).sine[0]) / bins.bin(peak).energy;
      EXPECT_GT(r2, 0.005);
      EXPECT_LE(r2, 1);
    }
  }
}

struct Expected {
  double height, peak, energy, cosine, sine;
};

// Computed by an independent script from the files' numbers.
void ExpectSea(const SeaSeries& series, const std::vector<Expected>& expected, double tolerance) {
  ASSERT_EQ(series.records.size(), expected.size());
  for (std::size_t r = 0; r < expected.size(); ++r) {
    const BinnedSpectrum& bins = *std::get<BinnedWaves>(series.records[r].waves);
    EXPECT_NEAR(series.records[r].significant_wave_height(), expected[r].height, 1e-6);
    const DirectionalEnergy at_peak = bins(expected[r].peak);
    EXPECT_NEAR(at_peak.energy, expected[r].energy, 1e-6);
    EXPECT_NEAR(at_peak.cosine[0] / at_peak.energy, expected[r].cosine, tolerance);
    EXPECT_NEAR(at_peak.sine[0] / at_peak.energy, expected[r].sine, tolerance);
  }
}

TEST_F(RealSea, OfWavewatchHasItsEnergyAndDirections) {
  const auto series = Read("ww3station.spec");
  ExpectSea(*series,
            {{1.1573161, 0.0737, 2.3552514, -0.5335142, -0.7107709},
             {1.1264267, 0.0737, 2.2944401, -0.5376748, -0.7094678},
             {1.1016349, 0.0737, 2.2249140, -0.5407737, -0.7076597},
             {1.0822217, 0.0737, 2.1564333, -0.5425017, -0.7067318}},
            1e-6);
  EXPECT_EQ(series->records[0].water_depth, 46.6);
}

TEST_F(RealSea, OfSwanHasItsEnergyAndDirections) {
  const auto series = Read("swanfile.spec");
  ExpectSea(*series,
            {{1.7164066, 0.0737, 4.1474047, -0.7131207, 0.6381822},
             {2.7623683, 0.0652, 9.5870222, -0.7815282, 0.5537536},
             {2.9256968, 0.0652, 15.5094185, -0.7676162, 0.5745886},
             {2.6736112, 0.0737, 5.8240512, -0.7273351, 0.6174943},
             {4.2595675, 0.0737, 20.9132166, -0.7476502, 0.5612418}},
            1e-6);
}

// Trapezoids of 5 % in k, 2.5 to 5 % in f, miss the kinks of a spectrum of straight lines between bins of 7 % or more:
// were all energy in one bin, by up to (5 / 7)^2 / 8 = 6 % of the height. Real spectra have many bins of energy.
TEST_F(RealSea, KeepsItsHeightOnTheWayToWavenumbers) {
  for (const char* name : {"41010.data_spec", "41010w2019part.txt.gz", "ww3station.spec", "swanfile.spec"}) {
    const auto series = Read(name);
    for (const SeaRecord& record : series->records) {
      const double height =
          SignificantWaveHeight(ByWavenumber(*std::get<BinnedWaves>(record.waves), 15, 0, SeaWavenumbers()));
      EXPECT_NEAR(height / record.significant_wave_height(), 1, 0.01) << name;
    }
  }
}

}  // namespace
}  // namespace albtpu
