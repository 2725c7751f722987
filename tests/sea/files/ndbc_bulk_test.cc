#include "sea/files/ndbc_bulk.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wind_sea.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

using albtpu::testing::kDegree;

const std::string kSummary =
    "#YY  MM DD hh mm WVHT  SwH  SwP  WWH  WWP SwD WWD  STEEPNESS  APD MWD\n"
    "#yr  mo dy hr mn    m    m  sec    m  sec  -  degT     -      sec degT\n"
    "2020 06 08 03 40  1.1  1.0  5.6  0.5  3.6 SSW  SE      STEEP  4.9 196\n"
    "2020 06 08 02 40  1.2   MM   MM  0.9  5.9  MM   S      STEEP  4.8 175\n"
    "2020 06 08 01 40   MM   MM   MM   MM   MM  MM  MM        N/A   MM  MM\n";

const std::string kMeteorology =
    "#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES  ATMP\n"
    "#yr  mo dy hr mn degT m/s  m/s     m   sec   sec degT   hPa  degC\n"
    "2026 07 31 11 40  10  4.0  4.0   1.2     7   6.6 191 1021.2    MM\n"
    "2026 07 31 11 30  MM   MM  4.0   1.2     7   6.6  MM 1021.2    MM\n"
    "2026 07 31 11 20 360  4.0  6.0    MM    MM    MM  MM 1021.0    MM\n";

const std::vector<JonswapWaves>& Components(const SeaRecord& record) { return *std::get<WaveComponents>(record.waves); }

TEST(NdbcSummary, TellsSwellFromWindWaves) {
  const auto series = ReadNdbcBulk(kSummary);
  ASSERT_EQ(series->records.size(), 2u);
  const auto& waves = Components(series->records[1]);
  ASSERT_EQ(waves.size(), 2u);
  EXPECT_EQ(waves[0].significant_wave_height, 0.5);
  EXPECT_EQ(waves[0].peak_period, 3.6);
  EXPECT_EQ(waves[0].gamma, 3.3);
  EXPECT_NEAR(std::remainder(waves[0].travels_towards - (135 + 180) * kDegree, 2 * std::numbers::pi), 0, 1e-12);
  EXPECT_EQ(waves[1].significant_wave_height, 1.0);
  EXPECT_EQ(waves[1].gamma, 7);
  EXPECT_NEAR(std::remainder(waves[1].travels_towards - (202.5 + 180) * kDegree, 2 * std::numbers::pi), 0, 1e-12);
  EXPECT_NEAR(series->records[1].significant_wave_height(), std::hypot(0.5, 1.0), 1e-12);
}

TEST(NdbcSummary, LeavesOutWhatIsMissing) {
  const auto series = ReadNdbcBulk(kSummary);
  ASSERT_EQ(Components(series->records[0]).size(), 1u);
  EXPECT_EQ(Components(series->records[0])[0].peak_period, 5.9);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 records have no waves")));
  EXPECT_THAT(series->assumed, Contains(HasSubstr("swell gamma 7")));
}

TEST(NdbcMeteorology, HasOneHeightAndTheWind) {
  const auto series = ReadNdbcBulk(kMeteorology);
  ASSERT_EQ(series->records.size(), 2u);
  const SeaRecord& record = series->records[1];
  EXPECT_EQ(Components(record)[0].significant_wave_height, 1.2);
  EXPECT_NEAR(Components(record)[0].travels_towards, (191 + 180) * kDegree, 1e-12);
  EXPECT_NEAR(*record.wind_speed_10m, 4, 1e-12);
  EXPECT_NEAR(*record.wind_from, 10 * kDegree, 1e-12);
  EXPECT_FALSE(series->records[0].wind_speed_10m.has_value());
  EXPECT_EQ(Components(series->records[0])[0].spread, std::numbers::sqrt2);  // no direction
  EXPECT_THAT(series->assumed, Contains(HasSubstr("swell and wind waves are not separated")));
}

TEST(NdbcMeteorology, BringsTheWindOfALowAnemometerTo10m) {
  const auto series = ReadNdbcBulk(kMeteorology, 4.1);
  EXPECT_NEAR(WindSpeedAt(4.1, *series->records[1].wind_speed_10m), 4, 1e-9);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("measured 4.1 m above the water")));
}

TEST(NdbcMeteorology, HasNinesForMissingValuesInTheHistory) {
  const auto series = ReadNdbcBulk(
      "YYYY MM DD hh WD   WSPD GST  WVHT  DPD   APD  MWD  BAR\n"
      "2000 01 01 00 230 07.2 09.0 01.10 99.00 04.00 999 1020.1\n"
      "2000 01 01 01 999 99.0 99.0 01.20 08.00 04.00 999 1020.1\n"
      "2000 01 01 02 230 07.2 09.0 99.00 08.00 04.00 999 1020.1\n");
  ASSERT_EQ(series->records.size(), 1u);
  EXPECT_EQ(Components(series->records[0])[0].peak_period, 8);
  EXPECT_FALSE(series->records[0].wind_speed_10m.has_value());
  EXPECT_FALSE(series->records[0].wind_from.has_value());
}

TEST(NdbcBulk, RefusesWhatIsDamaged) {
  const std::string header = kSummary.substr(0, kSummary.find("2020"));
  const auto error = [&](const std::string& line) {
    return std::string(ReadNdbcBulk(header + line + "\n").status().message());
  };
  EXPECT_THAT(error("2020 06 08 03 40  1.1  1.0  5.6  0.5  3.6 SSW"),
              HasSubstr("line 3: has 11 columns (expected 15)"));
  EXPECT_THAT(error("2020 06 88 03 40  1.1  1.0  5.6  0.5  3.6 SSW  SE  STEEP  4.9 196"), HasSubstr("a date and time"));
  EXPECT_THAT(error("2020 06 08 03 40  1.1  -1.  5.6  0.5  3.6 SSW  SE  STEEP  4.9 196"), HasSubstr("'-1.'"));
  EXPECT_THAT(error("2020 06 08 03 40  1.1  1.0  .01  0.5  3.6 SSW  SE  STEEP  4.9 196"),
              HasSubstr("has a period of 0.01 s"));
  EXPECT_THAT(error("2020 06 08 03 40  1.1  1.0  5.6  0.5  3.6 400  SE  STEEP  4.9 196"), HasSubstr("no direction"));
  EXPECT_THAT(error("2020 06 08 03 40  1.1   MM   MM   MM   MM  MM  MM  N/A    MM  MM"), HasSubstr("has waves"));
  EXPECT_FALSE(ReadNdbcBulk(kSummary.substr(0, kSummary.size() - 1)).ok());
}

TEST(NdbcMeteorology, DoesNotTakeWavesWithoutAPeriodForNone) {
  const std::string columns =
      "#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES  ATMP\n"
      "#yr  mo dy hr mn degT m/s  m/s     m   sec   sec degT   hPa  degC\n";
  const std::string without = "2026 07 31 12 00  90  8.0  9.0   2.5 99.00  5.90 191 1021.2    MM\n";
  EXPECT_THAT(std::string(ReadNdbcBulk(columns + without).status().message()),
              HasSubstr("a period (DPD) of at most 25 s with the height of its waves, up to 2.5 m"));
  const auto series =
      ReadNdbcBulk(columns + without + "2026 07 31 11 00  90  8.0  9.0   1.2     7   6.6 191 1021.2    MM\n");
  ASSERT_TRUE(series.ok()) << series.status();
  EXPECT_EQ(series->records.size(), 1u);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 heights of waves, up to 2.5 m, have no period")));
  const auto too_long = ReadNdbcBulk(columns + "2026 07 31 12 00  90  8.0  9.0   0.4 33.33  5.90 191 1021.2    MM\n" +
                                     "2026 07 31 11 00  90  8.0  9.0   1.2    25   6.6 191 1021.2    MM\n");
  ASSERT_TRUE(too_long.ok()) << too_long.status();
  EXPECT_EQ(too_long->records.size(), 1u);
  EXPECT_THAT(too_long->assumed, Contains(HasSubstr("or one above 25 s")));
  EXPECT_THAT(series->assumed, Not(Contains(HasSubstr("have no waves"))));
}

// A station on the coast (C-MAN), which has an anemometer and no waves.
const std::string kCoast =
    "#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES  ATMP\n"
    "#yr  mo dy hr mn degT m/s  m/s     m   sec   sec degT   hPa  degC\n"
    "2026 07 31 13 00  90  8.0  9.0    MM    MM    MM  MM 1021.2    MM\n"
    "2026 07 31 12 00  MM  8.0  9.0    MM    MM    MM  MM 1021.2    MM\n"
    "2026 07 31 11 00 180  6.0  6.0    MM    MM    MM  MM 1021.0    MM\n";

TEST(NdbcWinds, StandForTheirSeaWhereNoRecordHasWaves) {
  const auto series = ReadNdbcBulk(kCoast);
  ASSERT_TRUE(series.ok()) << series.status();
  EXPECT_EQ(series->format, "NDBC winds");
  ASSERT_EQ(series->records.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<WindAlone>(series->records[0].waves));
  EXPECT_NEAR(series->records[0].wind_speed_10m.value(), 6, 1e-12);
  EXPECT_NEAR(series->records[0].wind_from.value(), std::numbers::pi, 1e-12);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("it has no waves: the sea of each record is that of its wind")));
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 records have no wind or no direction")));
  // That of the same wind without a file.
  const DescribedSea sea = Describe(series->records[0]);
  const DescribedSea expected = Describe(SeaDescription{.wind_speed_10m = 6, .wind_from = std::numbers::pi});
  EXPECT_NEAR(SignificantWaveHeight(sea.spectrum), SignificantWaveHeight(expected.spectrum), 1e-9);
  EXPECT_NEAR(sea.x_azimuth, expected.x_azimuth, 1e-9);
  EXPECT_GT(series->records[0].significant_wave_height(), 0.5);
}

TEST(NdbcWinds, AreReadFromContinuousWindsAndOldFiles) {
  for (const char* text : {"#YY  MM DD hh mm WDIR WSPD GDR GST GTIME\n2019 01 01 00 00 180 6.0 999 99.0 9999\n",
                           "YY MM DD hh WD   WSPD GST  WVHT  DPD   APD  MWD  BAR\n"
                           "89 01 01 00 180 06.0 07.4 99.00 99.00 99.00 999 1028.5\n",
                           "YYYY MM DD hh mm  WD  WSPD GST  WVHT  DPD   APD  MWD  BAR\n"
                           "2005 01 01 00 30 180 06.0 07.4 99.00 99.00 99.00 999 1028.5\n"}) {
    SCOPED_TRACE(text);
    ASSERT_TRUE(IsNdbcBulk(std::string_view(text).substr(0, std::string_view(text).find('\n'))));
    const auto series = ReadNdbcBulk(text);
    ASSERT_TRUE(series.ok()) << series.status();
    EXPECT_NEAR(series->records[0].wind_speed_10m.value(), 6, 1e-12);
  }
}

TEST(NdbcWinds, SayWhatIsMissing) {
  const auto error = [](const std::string& text) { return std::string(ReadNdbcBulk(text).status().message()); };
  const std::string head = "#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD\n2026 07 31 13 00 ";
  EXPECT_THAT(error(head + "MM 8.0 9.0 MM MM\n"), HasSubstr("its direction is missing"));
  EXPECT_THAT(error(head + "90 MM 9.0 MM MM\n"), HasSubstr("its speed is missing"));
  EXPECT_THAT(error(head + "90 MM 9.0 MM MM\n"), HasSubstr("has waves (height or period is missing)"));
  EXPECT_THAT(error("#YY  MM DD hh mm WVHT DPD\n2026 07 31 13 00 MM MM\n"), HasSubstr("no column WSPD"));
  EXPECT_THAT(error("#YY  MM DD hh mm WDIR WSPD\n2026 07 31 13 00 MM MM\n"), HasSubstr("no column WVHT"));
  EXPECT_TRUE(ReadNdbcBulk(head + "MM 0.0 0.0 MM MM\n").ok());  // A calm has no direction.
}

}  // namespace
}  // namespace albtpu
