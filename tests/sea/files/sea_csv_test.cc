#include "sea/files/sea_csv.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "sea/spectra/apel_spectrum.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

using albtpu::testing::kDegree;

std::string ErrorOfCsv(const std::string& text) { return std::string(ReadSeaCsv(text).status().message()); }

TEST(SeaCsvByFrequency, HasEnergyAndDirections) {
  const auto series =
      ReadSeaCsv("# a comment\nf, E, r2, alpha2\n0.05,0.12,0.4,230\n\n0.06,0.3,,\n# more\n0.07,0,0.1,5\n");
  const BinnedSpectrum& bins = *std::get<BinnedWaves>(series->records[0].waves);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_NEAR(bins.bin(0).cosine[0], 0.12 * 0.4 * std::cos(460 * kDegree), 1e-15);
  EXPECT_EQ(bins.bin(1).energy, 0.3);
  EXPECT_EQ(bins.bin(1).cosine[0], 0);
  EXPECT_EQ(bins.trusted_up_to(), 0.07);
  EXPECT_FALSE(series->records[0].time.has_value());
}

TEST(SeaCsvByFrequency, MayHaveNoDirections) {
  const auto series = ReadSeaCsv("f,E\n0.05,0.12\n0.06,0.3\n");
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 records have no r2 or alpha2")));
  EXPECT_EQ(std::get<BinnedWaves>(series->records[0].waves)->bin(1).energy, 0.3);
}

TEST(SeaCsvByFrequency, MayBeASeries) {
  const auto series = ReadSeaCsv(
      "time,f,E\n2020-06-08T03:50Z,0.05,0.1\n2020-06-08T03:50Z,0.06,0.3\n"
      "2020-06-08T02:50:00Z,0.1,0.2\n2020-06-08T02:50:00Z,0.2,0.4\n");
  ASSERT_EQ(series->records.size(), 2u);
  EXPECT_EQ(series->records[0].time, 1591584600);
  EXPECT_EQ(std::get<BinnedWaves>(series->records[0].waves)->centre(1), 0.2);
  EXPECT_EQ(series->records[1].time, 1591588200);
}

// Apel's spectrum written to a file and read is the built-in one: no tail is joined to a complete sea.
TEST(SeaCsvByWavenumber, IsTheSpectrumThatWasWritten) {
  const HarmonicSpectrum apel = Sampled(ApelSpectrum(8, std::numeric_limits<double>::infinity()), SeaWavenumbers(), 2);
  std::string text = "k,S,a2,b2,a4,b4\n";
  for (std::size_t i = 0; i < apel.size(); ++i)
    absl::StrAppendFormat(&text, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", apel.k[i], apel.s[i], apel.a[0][i],
                          apel.b[0][i], apel.a[1][i], apel.b[1][i]);
  const auto series = ReadSeaCsv(text);
  const DescribedSea sea = Describe(series->records[0], {.wind_speed_10m = 8, .wind_from = 0.5});
  EXPECT_NEAR(sea.x_azimuth, 0.5 + std::numbers::pi, 1e-15);
  EXPECT_NEAR(Describe(series->records[0], {.wind_from = 4}).x_azimuth, 4 - std::numbers::pi, 1e-15);
  EXPECT_EQ(sea.spectrum.s, apel.s);
  for (std::size_t i = 0; i < apel.size(); ++i) {
    if (apel.s[i] == 0) continue;
    EXPECT_NEAR(sea.spectrum.a[0][i], apel.a[0][i], 1e-15);
    EXPECT_NEAR(sea.spectrum.a[1][i], apel.a[1][i], 1e-15);
  }
}

TEST(SeaCsv, RefusesWhatIsNoSea) {
  EXPECT_THAT(ErrorOfCsv("f,S\n1,2\n"),
              HasSubstr("line 1: has the columns 'f,S' (expected f,E,r2,alpha2 or k,S,a2,b2"));
  EXPECT_THAT(ErrorOfCsv("k,S,a2\n1,2,3\n"), HasSubstr("line 1: has the columns"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,2\n0.2\n"), HasSubstr("line 3: has 1 cells (expected 2)"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,2\n0.1,2\n"), HasSubstr("line 3: f is 0.1 (expected more than the line before"));
  EXPECT_THAT(ErrorOfCsv("f,E\n1e-300,2\n0.1,2\n"), HasSubstr("line 2: f is 1e-300 (expected 0.0001 to 100)"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,2\n0.2,-1\n"), HasSubstr("line 3: E is -1 (expected 0 to 1e+12)"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,2\n0.2,nan\n"), HasSubstr("'nan' is no number"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,\n"), HasSubstr("'' is no number"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,1\n"), HasSubstr("a sea of 1 lines"));
  EXPECT_THAT(ErrorOfCsv("f,E\n"), HasSubstr("a sea of 0 lines"));
  EXPECT_THAT(ErrorOfCsv("f,E,r2,alpha2\n0.1,1,41,230\n"),
              HasSubstr("r2 is 41 (expected a fraction from 0 to 1); divide r2 by 100 if it is in hundredths"));
  EXPECT_THAT(ErrorOfCsv("f,E,r2,alpha2\n0.1,1,0.4,361\n"), HasSubstr("alpha2 is 361"));
  EXPECT_THAT(ErrorOfCsv("k,S,a2,b2\n0.1,1,0.9,0.9\n"), HasSubstr("harmonic 2 is 0.9, 0.9"));
  EXPECT_THAT(ErrorOfCsv("time,f,E\n2020-06-08 03:50,0.1,1\n"), HasSubstr("is no time (expected UTC such as"));
  EXPECT_THAT(ErrorOfCsv("f,E\n0.1,1\n0.2,3"), HasSubstr("its last line, 3, has no end"));
}

std::string Compressed(std::string text) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&stream, text.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

TEST(Gzip, InflatesOneStreamOrSeveral) {
  const std::string text(200'000, 'x');
  EXPECT_TRUE(IsGzip(Compressed(text)));
  EXPECT_FALSE(IsGzip("#YY"));
  EXPECT_EQ(*Inflated(Compressed(text)), text);
  EXPECT_EQ(*Inflated(Compressed("one ") + Compressed("two")), "one two");
  EXPECT_EQ(*Inflated(Compressed("")), "");
}

TEST(Gzip, RefusesStreamsThatWereCutOrDamaged) {
  const std::string bytes = Compressed("0.12 0.34 0.56 0.78 0.90 0.12 0.35");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(std::string(Inflated(bytes.substr(0, size)).status().message()), HasSubstr("end early")) << size;
  std::string damaged = bytes;
  damaged[damaged.size() - 6] ^= 1;  // of the checksum
  EXPECT_THAT(std::string(Inflated(damaged).status().message()), HasSubstr("damaged"));
  EXPECT_THAT(std::string(Inflated(bytes + "rest").status().message()), HasSubstr("damaged"));
}

TEST(Gzip, RefusesMoreThanItsLimit) {
  const std::string bytes = Compressed(std::string(1'000'000, '\0'));
  EXPECT_LT(bytes.size(), 2000u);
  EXPECT_THAT(std::string(Inflated(bytes, 999'999).status().message()), HasSubstr("more than 999999 bytes"));
  EXPECT_TRUE(Inflated(bytes, 1'000'000).ok());
}

}  // namespace
}  // namespace albtpu
