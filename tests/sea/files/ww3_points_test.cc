#include "sea/files/ww3_points.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "absl/strings/str_cat.h"
#include "sea/spectra/wave_spreading.h"
#include "tests/degree.h"
#include "tests/sea/files/foreign_texts.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

using albtpu::testing::kDegree;

const std::string kWw3Header =
    "'WAVEWATCH III SPECTRA'      2     8     1 'spectral resolution for points'\n"
    " 0.100E+00 0.200E+00\n"
    "  0.157E+01  0.785E+00  0.000E+00  0.550E+01  0.471E+01  0.393E+01  0.314E+01\n"
    "  0.236E+01\n";

// All energy at 0.2 Hz, towards 0.785 rad of the compass: 0.6 m^2/Hz/rad.
const std::string kRecord =
    "20220912 060000\n"
    "'44097     '  40.98 -71.12      46.6   1.45 225.6   0.18  94.1\n"
    "  0.000E+00  0.000E+00  0.000E+00  0.600E+00  0.000E+00  0.000E+00  0.000E+00\n"
    "  0.000E+00  0.000E+00  0.000E+00  0.000E+00  0.000E+00  0.000E+00  0.000E+00\n"
    "  0.000E+00  0.000E+00\n";

std::string ErrorOfWw3(const std::string& text) { return std::string(ReadWw3Points(text).status().message()); }

// Densities per rad, frequency after frequency for each direction, and directions in rad: read otherwise, the energy
// would be 57 times less, at another frequency, or along another axis.
TEST(Ww3Points, HasDensitiesPerRadAndDirectionsInRad) {
  const auto series = ReadWw3Points(kWw3Header + kRecord);
  const BinnedSpectrum& bins = Bins(series->records[0]);
  EXPECT_EQ(bins.bin(0).energy, 0);
  EXPECT_NEAR(bins.bin(1).energy, 0.6 * 2 * std::numbers::pi / 8, 1e-12);
  EXPECT_NEAR(bins.bin(1).PrincipalAxis(), 0.785, 1e-12);
  EXPECT_EQ(bins.trusted_up_to(), 0.2);
}

TEST(Ww3Points, HasPlaceTimeDepthAndWind) {
  const auto series = ReadWw3Points(kWw3Header + kRecord);
  EXPECT_EQ(series->points[0].name, "44097");
  EXPECT_EQ(series->points[0].latitude, 40.98);
  EXPECT_EQ(series->points[0].longitude, -71.12);
  const SeaRecord& record = series->records[0];
  EXPECT_EQ(record.time, 1662962400);
  EXPECT_EQ(record.water_depth, 46.6);
  EXPECT_EQ(record.wind_speed_10m, 1.45);
  EXPECT_NEAR(*record.wind_from, 225.6 * kDegree, 1e-12);
}

// Waves towards 0.785 rad with a wind from the opposite direction run along the frame's x axis.
TEST(Ww3Points, HasWavesTowardsAndWindFrom) {
  const auto series = ReadWw3Points(kWw3Header + Replaced(kRecord, "225.6", "225.0"));
  const HarmonicSpectrum spectrum = Describe(series->records[0], {.tail = TailRule::kNone}).spectrum;
  std::size_t i = 0;
  while (spectrum.s[i] == 0) ++i;
  EXPECT_NEAR(spectrum.a[0][i], 1, 1e-6);
  EXPECT_NEAR(spectrum.b[0][i], 0, 2e-3);
}

TEST(Ww3Points, MayHaveNumbersThatTouch) {
  const auto series = ReadWw3Points(kWw3Header + Replaced(kRecord, "40.98 -71.12", "40.98-171.12"));
  EXPECT_EQ(series->points[0].longitude, -171.12);
  EXPECT_EQ(series->records[0].water_depth, 46.6);
}

TEST(Ww3Points, MayHaveExponentsOfThreeDigits) {
  const auto series = ReadWw3Points(kWw3Header + Replaced(kRecord, "0.000E+00\n", "0.123-104\n"));
  EXPECT_TRUE(series.ok()) << series.status();
}

TEST(Ww3Points, TellsItsPointsApart) {
  std::string text = Replaced(kWw3Header, "8     1", "8     2");
  const std::string second = Replaced(kRecord.substr(kRecord.find('\'')), "44097", "44098");
  text += kRecord + second + Replaced(kRecord, "060000", "050000") + second;
  const auto series = ReadWw3Points(text);
  ASSERT_EQ(series->points.size(), 2u);
  ASSERT_EQ(series->records.size(), 4u);
  EXPECT_EQ(series->points[1].name, "44098");
  EXPECT_EQ(series->records[0].point, 0u);
  EXPECT_LT(series->records[0].time, series->records[1].time);
  EXPECT_EQ(series->records[3].point, 1u);
}

TEST(Ww3Points, IsRefusedWhereItWasCut) {
  const std::string text = kWw3Header + kRecord + Replaced(kRecord, "060000", "070000");
  const std::size_t first = (kWw3Header + kRecord).size();
  for (std::size_t size = 0; size < text.size(); ++size) {
    const auto series = ReadWw3Points(std::string_view(text).substr(0, size));
    // The end of the last line alone may be missing: its last number ends where one of the line before does.
    const bool whole = size == first || size == first - 1 || size == text.size() - 1;
    EXPECT_EQ(series.ok(), whole) << size << ": " << series.status();
  }
}

TEST(Ww3Points, RefusesDirectionsInDegrees) {
  EXPECT_THAT(ErrorOfWw3(Replaced(kWw3Header, "0.550E+01", "315.0E+00") + kRecord),
              HasSubstr("a direction is 315 rad (expected 0 to 2 pi); write directions in radians"));
}

TEST(Ww3Points, RefusesWhatIsDamaged) {
  EXPECT_THAT(ErrorOfWw3(Replaced(kWw3Header, "8     1", "0     1") + kRecord),
              HasSubstr("line 1: does not state the numbers of"));
  EXPECT_THAT(ErrorOfWw3(Replaced(kWw3Header, "2     8", "9999999 8") + kRecord),
              HasSubstr("line 1: does not state the numbers of"));
  EXPECT_THAT(ErrorOfWw3(Replaced(kWw3Header, "0.200E+00", "0.100E+00") + kRecord),
              HasSubstr("frequency 2 is 0.1 Hz (expected 0.0001 to 100 Hz, increasing)"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header + Replaced(kRecord, "20220912", "20221312")),
              HasSubstr("line 5: '20221312 060000' is no"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header + Replaced(kRecord, "46.6", "-1.0")),
              HasSubstr("line 6: does not state a possible"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header + Replaced(kRecord, "1.45", "1E99")),
              HasSubstr("line 6: does not state a possible"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header + Replaced(kRecord, "0.600E+00", "-.600E+00")), HasSubstr("a density of -0.6"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header + Replaced(kRecord, "0.600E+00", "NaN")),
              HasSubstr("'NaN' is not a spectral density"));
  EXPECT_THAT(ErrorOfWw3(kWw3Header), HasSubstr("a header and no record"));
}

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> Directions(std::size_t count, double first) {
  std::vector<double> directions;
  for (std::size_t i = 0; i < count; ++i) directions.push_back(first + kTurn * static_cast<double>(i) / count);
  return directions;
}

// cos^2s of half the angle from 0.6 rad with s = 4 has harmonics up to 4, which 36 bins integrate exactly.
TEST(DirectionalBins, GiveTheHarmonicsOfASpreading) {
  const auto expected = Cosine2sHarmonics(4);
  for (const double first : {0.0, 0.05, -3.0, 50.0}) {
    const std::vector<double> directions = Directions(36, first);
    std::vector<double> densities;
    for (const double c : directions) densities.push_back(std::pow(std::cos((c - 0.6) / 2), 8));
    const DirectionalEnergy sum = DirectionalBins(directions).Sum(densities);
    EXPECT_NEAR(sum.energy, kTurn * 35.0 / 128, 1e-12);  // the mean of cos^8 is 35/128
    EXPECT_NEAR(sum.cosine[0] / sum.energy, expected[0] * std::cos(1.2), 1e-12);
    EXPECT_NEAR(sum.sine[0] / sum.energy, expected[0] * std::sin(1.2), 1e-12);
    EXPECT_NEAR(sum.sine[1] / sum.energy, expected[1] * std::sin(2.4), 1e-12);
    EXPECT_NEAR(sum.cosine[2], 0, 1e-12);
  }
}

TEST(DirectionalBins, MayRunEitherWay) {
  std::vector<double> directions = Directions(24, 0.1), densities;
  for (const double c : directions) densities.push_back(1 + std::cos(c - 1));
  const DirectionalEnergy forward = DirectionalBins(directions).Sum(densities);
  const DirectionalEnergy backward = DirectionalBins({directions.rbegin(), directions.rend()})
                                         .Sum(std::vector<double>(densities.rbegin(), densities.rend()));
  EXPECT_NEAR(forward.energy, backward.energy, 1e-14);
  EXPECT_NEAR(forward.cosine[0], backward.cosine[0], 1e-14);
}

TEST(DirectionalBins, AreEqualWhereDirectionsWereRounded) {
  std::vector<double> directions = Directions(36, 0.0), densities(36);
  densities[7] = 1;
  for (double& c : directions) c = std::round(c * 100) / 100;
  EXPECT_NEAR(DirectionalBins(directions).Sum(densities).energy, kTurn / 36, 1e-15);
}

// A sector of 90 degrees in steps of 5: its ends are bins like the others.
TEST(DirectionalBins, MayCoverASector) {
  std::vector<double> directions;
  for (int i = 0; i <= 18; ++i) directions.push_back(kTurn * (350 + 5 * i) / 360);
  const DirectionalEnergy sum = DirectionalBins(directions).Sum(std::vector<double>(19, 1));
  EXPECT_NEAR(sum.energy, kTurn * 95 / 360, 1e-12);
}

// The first and the last direction, 0 and 360 degrees, may be the same: each has half of the bin.
TEST(DirectionalBins, MayCloseTheCircleTwice) {
  std::vector<double> directions = Directions(36, 0.0);
  directions.push_back(kTurn);
  EXPECT_NEAR(DirectionalBins(directions).Sum(std::vector<double>(37, 1)).energy, kTurn, 1e-12);
}

TEST(DirectionalBins, KeepHarmonicsBelowAQuarterOfTheirNumber) {
  EXPECT_EQ(DirectionalBins(Directions(8, 0)).harmonics(), 1u);
  EXPECT_EQ(DirectionalBins(Directions(9, 0)).harmonics(), 2u);
  EXPECT_EQ(DirectionalBins(Directions(12, 0)).harmonics(), 2u);
  EXPECT_EQ(DirectionalBins(Directions(24, 0)).harmonics(), 5u);
  EXPECT_EQ(DirectionalBins(Directions(72, 0)).harmonics(), kSeaHarmonics);
}

}  // namespace
}  // namespace albtpu
