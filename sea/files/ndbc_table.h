// The tables of values by frequency in which NDBC publishes spectra: one file each for energy, directions and spreads.
//
// In real time a line has pairs of a value and its frequency in parentheses:
//
//     #YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >
//     2020 06 08 03 50 0.225 0.000 (0.033) 0.000 (0.038) ...
//
// In the history the first line has the frequencies. Old files have years of two digits, no minutes and no #:
//
//     #YY  MM DD hh mm  .0200  .0325  .0375 ...           YY MM DD hh   .03   .04 ...
//     2019 02 06 00 40   0.00   0.00   0.12 ...           96 01 01 00   .00   .12 ...
//
// Missing values are 999 with any number of decimals. Spreads r1 and r2 are fractions in real time and hundredths in
// the history, whose files do not say which quantity they have; their names do.
//
// Source: https://www.ndbc.noaa.gov/faq/measdes.shtml
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

// The columns of date and time with which each line of an NDBC file begins.

struct NdbcDate {
  std::size_t count = 0;  // of columns: 5, or 4 without minutes; 0 if the header is not one of NDBC
};

// Of the words of a header: YY or YYYY, with or without #, then MM, DD, hh and perhaps mm.
NdbcDate NdbcDateColumns(std::span<const std::string_view> header);

// s since 1970-01-01T00:00:00Z of a line of data. Years of two digits are of the 20th century. nullopt if the line has
// no such date.
std::optional<double> NdbcTime(std::span<const std::string_view> words, NdbcDate date);

enum class NdbcQuantity {
  kEnergy,          // m^2/Hz
  kFirstDirection,  // alpha1, degrees from
  kDirection,       // alpha2, degrees from
  kFirstSpread,     // r1
  kSpread,          // r2, as a fraction
};

struct NdbcRow {
  double time;                                             // s since 1970-01-01T00:00:00Z
  std::shared_ptr<const std::vector<double>> frequencies;  // Hz, increasing; rows that have the same share them
  std::vector<double> values;                              // NaN: missing
};

struct NdbcTable {
  bool real_time;
  std::vector<NdbcRow> rows;
};

// Whether the first line of a text is that of such a table.
bool IsNdbcTable(std::string_view first_line);

// `expected` is the quantity that the file should have. Files in real time state theirs. Files of the history do not:
// they are refused where their values cannot be those of the quantity, such as r2 in fractions.
absl::StatusOr<NdbcTable> ReadNdbcTable(std::string_view text, NdbcQuantity expected);

}  // namespace albtpu
