#include "sea/files/ndbc_spectra.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sea/files/ndbc_table.h"
#include "tests/degree.h"
#include "tests/sea/files/foreign_texts.h"

namespace albtpu {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

using albtpu::testing::kDegree;

const std::string kEnergyHeader =
    "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >\n";
const std::string kEnergy = kEnergyHeader +
                            "2020 06 08 03 50 0.225 0.218 (0.100) 0.641 (0.200) 0.000 (0.400)\n"
                            "2020 06 08 02 50 9.999 0.100 (0.100) 0.200 (0.200) 0.300 (0.400)\n";
const std::string kSpread =
    "#YY  MM DD hh mm r2_1 (freq_1) r2_2 (freq_2) r2_3 (freq_3) ... >\n"
    "2020 06 08 03 50 0.33 (0.100) 0.50 (0.200) 999.00 (0.400)\n"
    "2020 06 08 02 50 0.40 (0.100) 0.50 (0.200) 0.60 (0.400)\n";
const std::string kDirection =
    "#YY  MM DD hh mm alpha2_1 (freq_1) alpha2_2 (freq_2) alpha2_3 (freq_3) ... >\n"
    "2020 06 08 03 50 30.0 (0.100) 999.0 (0.200) 120.0 (0.400)\n"
    "2020 06 08 02 50 30.0 (0.100) 90.0 (0.200) 120.0 (0.400)\n";

std::string ErrorOf(const NdbcTexts& texts) { return std::string(ReadNdbcSpectra(texts).status().message()); }

TEST(NdbcRealTime, HasPairsOfValuesAndFrequenciesBehindTheSeparationFrequency) {
  const auto series = ReadNdbcSpectra({.energy = kEnergy, .spread = kSpread, .direction = kDirection});
  ASSERT_EQ(series->records.size(), 2u);
  const BinnedSpectrum& bins = Bins(series->records[1]);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins.centre(0), 0.1);
  EXPECT_EQ(bins.bin(0).energy, 0.218);
  EXPECT_NEAR(bins.bin(0).cosine[0], 0.218 * 0.33 * std::cos(60 * kDegree), 1e-12);
  EXPECT_NEAR(bins.bin(0).sine[0], 0.218 * 0.33 * std::sin(60 * kDegree), 1e-12);
  EXPECT_EQ(bins.bin(2).energy, 0);
  EXPECT_EQ(bins.trusted_up_to(), 0.4);
}

TEST(NdbcRealTime, IsSortedFromNewestFirst) {
  const auto series = ReadNdbcSpectra({.energy = kEnergy});
  EXPECT_EQ(series->records[0].time, 1591584600);  // 02:50
  EXPECT_EQ(series->records[1].time, 1591588200);
  EXPECT_EQ(Bins(series->records[0]).bin(0).energy, 0.1);
}

TEST(NdbcRealTime, IsIsotropicWhereSpreadOrDirectionIsMissing) {
  const auto series = ReadNdbcSpectra({.energy = kEnergy, .spread = kSpread, .direction = kDirection});
  const BinnedSpectrum& bins = Bins(series->records[1]);
  for (const std::size_t i : {1, 2}) {  // alpha2 is 999.0, r2 is 999.00
    EXPECT_EQ(bins.bin(i).cosine[0], 0);
    EXPECT_EQ(bins.bin(i).sine[0], 0);
  }
}

TEST(NdbcRealTime, SaysWhereDirectionsAreMissing) {
  const auto without = ReadNdbcSpectra({.energy = kEnergy});
  EXPECT_THAT(without->assumed, Contains(HasSubstr("2 records have no r2 or alpha2")));
  // One bin of the later record lacks alpha2, and has three quarters of the energy.
  const auto partly = ReadNdbcSpectra({.energy = kEnergy, .spread = kSpread, .direction = kDirection});
  EXPECT_THAT(partly->assumed, Contains(HasSubstr("1 records have no r2 or alpha2")));
  const std::string one_row = kSpread.substr(0, kSpread.rfind("2020"));
  const auto of_one = ReadNdbcSpectra({.energy = kEnergy, .spread = one_row, .direction = kDirection});
  EXPECT_THAT(of_one->assumed, Contains(HasSubstr("2 records have no r2 or alpha2")));
  // Rows that are there, and have the number of a missing value in each bin.
  std::string missing = kDirection;
  for (const std::string value : {"30.0", "90.0", "120.0"})
    for (std::size_t at; (at = missing.find(" " + value + " ")) != std::string::npos;)
      missing.replace(at + 1, value.size(), "999.0");
  const auto rows = ReadNdbcSpectra({.energy = kEnergy, .spread = kSpread, .direction = missing});
  EXPECT_THAT(rows->assumed, Contains(HasSubstr("2 records have no r2 or alpha2")));
}

TEST(NdbcRealTime, LeavesOutBinsWithoutEnergyAndRecordsWithoutBins) {
  const auto series =
      ReadNdbcSpectra({.energy = kEnergyHeader + "2020 06 08 03 50 0.2 999.000 (0.1) 0.641 (0.2) 0.5 (0.4)\n"
                                                 "2020 06 08 02 50 0.2 999.000 (0.1) 999.000 (0.2) 0.5 (0.4)\n"});
  ASSERT_EQ(series->records.size(), 1u);
  EXPECT_EQ(Bins(series->records[0]).size(), 2u);
  EXPECT_EQ(Bins(series->records[0]).centre(0), 0.2);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 records have no energy")));
}

TEST(NdbcRealTime, MayChangeItsFrequencies) {
  const auto series =
      ReadNdbcSpectra({.energy = kEnergyHeader + "2020 06 08 03 50 0.2 0.1 (0.1) 0.641 (0.2)\n"
                                                 "2020 06 08 02 50 0.2 0.1 (0.15) 0.2 (0.25) 0.5 (0.4)\n"});
  EXPECT_EQ(Bins(series->records[0]).size(), 3u);
  EXPECT_EQ(Bins(series->records[1]).size(), 2u);
  EXPECT_EQ(Bins(series->records[1]).trusted_up_to(), 0.2);  // no bin above
}

TEST(NdbcRealTime, KnowsEachQuantityByItsHeader) {
  EXPECT_EQ(ErrorOf({.energy = kSpread}),
            "line 1: the file has r2 (expected spectral density); give the .data_spec file, with .swr2 and .swdir2 "
            "beside it");
  EXPECT_THAT(ErrorOf({.energy = kEnergy, .spread = kDirection, .direction = kDirection, .spread_name = "a.swr2"}),
              HasSubstr("beside it, a.swr2: line 1: the file has alpha2 (expected r2)"));
}

TEST(NdbcRealTime, RefusesWhatIsNoSpectrum) {
  const auto error = [](const std::string& line) { return ErrorOf({.energy = kEnergyHeader + line + "\n"}); };
  EXPECT_THAT(error("2020 06 31 03 50 0.2 0.1 (0.1) 0.6 (0.2)"), HasSubstr("line 2: does not begin with a date"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 0.1 (0.2) 0.6 (0.1)"), HasSubstr("0.1 Hz is not above the one before"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 0.1 (0.2) 0.6"), HasSubstr("value without frequency"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 0.1 0.2 0.6 0.3"), HasSubstr("no frequency in parentheses"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 -0.1 (0.2) 0.6 (0.3)"), HasSubstr("'-0.1' is no spectral density"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 MM (0.2) 0.6 (0.3)"), HasSubstr("'MM' is no number"));
  EXPECT_THAT(error("2020 06 08 03 50 0.2 0.5 (0.2)"), HasSubstr("has 1 frequencies"));
  EXPECT_THAT(ErrorOf({.energy = kEnergyHeader}), HasSubstr("a header and no record"));
}

// r2 of 33 is of the history, where 1 stands for 0.01: in real time it cannot be.
TEST(NdbcRealTime, HasFractionsOfSpread) {
  std::string hundredths = kSpread;
  hundredths.replace(hundredths.find("0.33"), 4, "33.0");
  EXPECT_THAT(ErrorOf({.energy = kEnergy, .spread = hundredths, .direction = kDirection}),
              HasSubstr("'33.0' is no r2 (expected 0 to 1)"));
}

const std::string kHistoryHeader = "#YY  MM DD hh mm  .0500  .1000  .2000\n";
const std::string kHistoryEnergy = kHistoryHeader + "2019 02 06 00 40   0.00   1.21   0.38\n";
const std::string kHistorySpread = kHistoryHeader + "2019 02 06 00 40     94     50    999\n";
const std::string kHistoryDirection = kHistoryHeader + "2019 02 06 00 40    146     24     30\n";

// Read as hundredths, fractions would make the waves isotropic.
TEST(NdbcHistory, HasNoFractionsOfSpread) {
  EXPECT_THAT(ErrorOf({.energy = kHistoryEnergy,
                       .spread = kHistoryHeader + "2019 02 06 00 40   0.94   0.50    999\n",
                       .direction = kHistoryDirection}),
              HasSubstr("its largest r2 is 0.94 (the history has hundredths, up to 100); multiply r2 by 100"));
}

TEST(NdbcHistory, HasHundredthsOfSpread) {
  const auto series =
      ReadNdbcSpectra({.energy = kHistoryEnergy, .spread = kHistorySpread, .direction = kHistoryDirection});
  const BinnedSpectrum& bins = Bins(series->records[0]);
  EXPECT_EQ(bins.centre(1), 0.1);
  EXPECT_NEAR(bins.bin(1).cosine[0], 1.21 * 0.5 * std::cos(48 * kDegree), 1e-12);
  EXPECT_EQ(bins.bin(2).cosine[0], 0);  // 999 is missing, not 9.99
  EXPECT_EQ(series->records[0].time, 1549413600);
}

TEST(NdbcHistory, MayLackMinutesAndCenturiesAndTheHash) {
  const auto old = ReadNdbcSpectra({.energy = "YY MM DD hh   .03   .04   .05\n96 02 29 23   .00   .12   .33\n"});
  EXPECT_EQ(old->records[0].time, 825634800);
  EXPECT_EQ(Bins(old->records[0]).bin(2).energy, 0.33);
  const auto newer = ReadNdbcSpectra({.energy = "YYYY MM DD hh   .030   .040\n2000 01 01 01    .00    .24\n"});
  EXPECT_EQ(newer->records[0].time, 946688400);
}

TEST(NdbcHistory, DoesNotMistakeDirectionsOrSpreadsForEnergy) {
  EXPECT_THAT(ErrorOf({.energy = kHistoryDirection}), HasSubstr("its values are whole numbers"));
  EXPECT_THAT(ErrorOf({.energy = kHistoryEnergy, .spread = kHistoryDirection, .direction = kHistorySpread}),
              HasSubstr("'146' is no r2 (expected 0 to 100)"));
}

TEST(NdbcHistory, DoesNotGoWithRealTime) {
  EXPECT_THAT(ErrorOf({.energy = kHistoryEnergy, .spread = kSpread, .direction = kDirection}),
              HasSubstr("is in real time (unlike the file of energy)"));
}

TEST(NdbcHistory, RefusesLinesOfAnotherLength) {
  EXPECT_THAT(ErrorOf({.energy = kHistoryHeader + "2019 02 06 00 40   0.00   1.21\n"}),
              HasSubstr("line 2: has 2 values (expected 3)"));
}

TEST(NdbcSpectra, AreRefusedWhereTheyWereCut) {
  for (const std::string& text : {kEnergy, kHistoryEnergy}) {
    for (std::size_t size = 0; size < text.size(); ++size) {
      const auto series = ReadNdbcSpectra({.energy = std::string_view(text).substr(0, size)});
      const bool ends_a_record = text[size - (size > 0 ? 1 : 0)] == '\n' && size > text.find('\n') + 1;
      EXPECT_EQ(series.ok(), ends_a_record) << size;
    }
  }
}

TEST(NdbcSpectra, HaveOneRecordForATime) {
  const std::string line = "2019 02 06 00 40   0.00   1.21   0.38\n";
  const auto series = ReadNdbcSpectra({.energy = kHistoryHeader + line + line});
  EXPECT_EQ(series->records.size(), 1u);
  EXPECT_THAT(series->assumed, Contains(HasSubstr("1 records repeat the time")));
}

}  // namespace
}  // namespace albtpu
