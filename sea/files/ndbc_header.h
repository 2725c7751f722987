// The columns of date and time with which each line of an NDBC file begins.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace albtpu {

struct NdbcDate {
  std::size_t count = 0;  // of columns: 5, or 4 without minutes; 0 if the header is not one of NDBC
};

// Of the words of a header: YY or YYYY, with or without #, then MM, DD, hh and perhaps mm.
NdbcDate NdbcDateColumns(std::span<const std::string_view> header);

// s since 1970-01-01T00:00:00Z of a line of data. Years of two digits are of the 20th century. nullopt if the line has
// no such date.
std::optional<double> NdbcTime(std::span<const std::string_view> words, NdbcDate date);

}  // namespace albtpu
