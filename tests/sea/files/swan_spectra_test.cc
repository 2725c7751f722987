#include "sea/files/swan_spectra.h"

#include <gmock/gmock.h>

#include <numbers>
#include <string>

#include "tests/degree.h"
#include "tests/sea/files/foreign_texts.h"

namespace albtpu {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

using albtpu::testing::kDegree;

const std::string kSwanHeader =
    "SWAN   1                                Swan standard spectral file\n"
    "$   a comment\n"
    "TIME                                    time-dependent data\n"
    "     1                                  time coding option\n"
    "LONLAT                                  locations in spherical coordinates\n"
    "     1                                  number of locations\n"
    "  174.672501  -38.173599\n"
    "AFREQ                                   absolute frequencies in Hz\n"
    "     2                                  number of frequencies\n"
    "    0.1000\n"
    "    0.2000\n"
    "NDIR                                    spectral nautical directions in degr\n"
    "     8                                  number of directions\n"
    "    10\n    55\n   100\n   145\n   190\n   235\n   280\n   325\n"
    "QUANT\n"
    "     1                                  number of quantities in table\n"
    "VaDens                                  variance densities in m2/Hz/degr\n"
    "m2/Hz/degr                              unit\n"
    "   -99                                  exception value\n";
const std::string kSpectrum =
    "FACTOR\n"
    "    0.1E-03\n"
    "    0    0    0    0    0    0    0    0\n"
    "    0   50    0    0    0    0    0    0\n";
const std::string kTime = "20161011.123000                         date and time\n";

std::string ErrorOfSwan(const std::string& text) { return std::string(ReadSwanSpectra(text).status().message()); }

TEST(SwanSpectra, HasDensitiesPerDegreeTimesTheFactor) {
  const auto series = ReadSwanSpectra(kSwanHeader + kTime + kSpectrum);
  EXPECT_EQ(Bins(series->records[0]).bin(0).energy, 0);
  EXPECT_NEAR(Bins(series->records[0]).bin(1).energy, 50 * 1e-4 * 45, 1e-12);
  EXPECT_EQ(series->records[0].time, 1476189000);
  EXPECT_EQ(series->points[0].longitude, 174.672501);
}

// The second direction: 55 degrees clockwise from the north, or counter-clockwise from the east, 35 of the compass.
TEST(SwanSpectra, HasNauticalOrCartesianDirections) {
  const auto nautical = ReadSwanSpectra(kSwanHeader + kTime + kSpectrum);
  const auto cartesian = ReadSwanSpectra(Replaced(kSwanHeader, "NDIR", "CDIR") + kTime + kSpectrum);
  ASSERT_TRUE(nautical.ok() && cartesian.ok()) << cartesian.status();
  EXPECT_NEAR(Bins(nautical->records[0]).bin(1).PrincipalAxis(), 55 * kDegree, 1e-12);
  EXPECT_NEAR(Bins(cartesian->records[0]).bin(1).PrincipalAxis(), 35 * kDegree, 1e-12);
}

TEST(SwanSpectra, MayHaveEnergyInsteadOfVariance) {
  const std::string header = Replaced(Replaced(kSwanHeader, "VaDens", "EnDens"), "m2/Hz/degr  ", "J/m2/Hz/degr");
  const auto series = ReadSwanSpectra(header + kTime + kSpectrum);
  EXPECT_NEAR(Bins(series->records[0]).bin(1).energy, 50 * 1e-4 * 45 / (1025 * 9.81), 1e-15);
}

TEST(SwanSpectra, HasNoWavesAtZeroAndNoRecordAtNodata) {
  const auto series =
      ReadSwanSpectra(kSwanHeader + kTime + "ZERO\n20161011.133000\nNODATA\n20161011.143000\n" + kSpectrum);
  ASSERT_EQ(series->records.size(), 2u);
  EXPECT_EQ(series->records[0].significant_wave_height(), 0);
  EXPECT_GT(series->records[1].significant_wave_height(), 0);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 spectra have no data")));
}

TEST(SwanSpectra, HasNoDataAtItsExceptionValue) {
  const auto series = ReadSwanSpectra(kSwanHeader + kTime + Replaced(kSpectrum, "  50", " -99") +
                                      Replaced(kTime, "12", "13") + kSpectrum);
  EXPECT_EQ(series->records.size(), 1u);
}

TEST(SwanSpectra, MayHaveManyNamedPlacesAndNoTime) {
  std::string header =
      Replaced(kSwanHeader,
               kSwanHeader.substr(kSwanHeader.find("TIME"), kSwanHeader.find("LONLAT") - kSwanHeader.find("TIME")), "");
  header = Replaced(header, "     1                                  number of loc", "     2      number of loc");
  header = Replaced(header, "-38.173599\n", "-38.173599 'buoy'\n  174.7 -38.2\n");
  header = Replaced(header, "LONLAT", "LOCATIONS");
  const auto series = ReadSwanSpectra(header + kSpectrum + "ZERO\n");
  ASSERT_EQ(series->points.size(), 2u);
  EXPECT_FALSE(series->points[0].longitude.has_value());  // m
  EXPECT_EQ(series->records[1].point, 1u);
  EXPECT_FALSE(series->records[0].time.has_value());
}

TEST(SwanSpectra, IsRefusedWhereItWasCut) {
  const std::string text = kSwanHeader + kTime + kSpectrum + Replaced(kTime, "1230", "1330") + kSpectrum;
  const std::size_t first = (kSwanHeader + kTime + kSpectrum).size();
  for (std::size_t size = 0; size < text.size(); ++size) {
    const auto series = ReadSwanSpectra(std::string_view(text).substr(0, size));
    const bool whole = size == first || size == first - 1 || size == text.size() - 1;
    EXPECT_EQ(series.ok(), whole) << size << ": " << series.status();
  }
}

TEST(SwanSpectra, RefusesDirectionsInRadians) {
  const std::string radians = Replaced(kSwanHeader, "    10\n    55\n   100\n   145\n   190\n   235\n   280\n   325\n",
                                       "0.17\n0.96\n1.75\n2.53\n3.32\n4.10\n4.89\n5.67\n");
  EXPECT_THAT(ErrorOfSwan(radians + kTime + kSpectrum), HasSubstr("the directions reach from 0.17 to 5.67 degrees"));
}

TEST(SwanSpectra, RefusesWhatItCannotRead) {
  const std::string rest = kTime + kSpectrum;
  EXPECT_THAT(ErrorOfSwan(Replaced(kSwanHeader, "AFREQ", "XFREQ") + rest), HasSubstr("line 8: begins with 'XFREQ'"));
  EXPECT_THAT(ErrorOfSwan(Replaced(kSwanHeader, "VaDens", "AcDens") + rest), HasSubstr("'AcDens' in 'm2/Hz/degr'"));
  EXPECT_THAT(
      ErrorOfSwan(Replaced(kSwanHeader, "     1                                  time", "     2   time") + rest),
      HasSubstr("line 4: states '2' (expected 1)"));
  EXPECT_THAT(ErrorOfSwan(kSwanHeader + Replaced(rest, "20161011", "20161032")), HasSubstr("is no date and time"));
  EXPECT_THAT(ErrorOfSwan(kSwanHeader + Replaced(rest, "FACTOR", "VECTOR")),
              HasSubstr("'VECTOR' begins no spectrum (expected FACTOR"));
  EXPECT_THAT(ErrorOfSwan(kSwanHeader + Replaced(rest, "  50", " -50")), HasSubstr("has a density of"));
  EXPECT_THAT(ErrorOfSwan(kSwanHeader), HasSubstr("has no spectrum"));
  const std::string one_dimension =
      kSwanHeader.substr(0, kSwanHeader.find("NDIR")) + kSwanHeader.substr(kSwanHeader.find("QUANT"));
  EXPECT_THAT(ErrorOfSwan(one_dimension + rest), HasSubstr("no directions; write them by SPECOUT with SPEC2D"));
}

}  // namespace
}  // namespace albtpu
