// The numbers of a table, laid out to be blended.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/query/record_blend.h"
#include "tables/table.h"

namespace albtpu {

// The place of the values or the standard errors of a quantity.
struct RecordPlace {
  std::size_t set = 0;   // index into NodeRecords::sets
  std::size_t lane = 0;  // which of the 4 numbers of a record
};

// Quantities over all axes and quantities over all but the last have sets of their own. Up to two quantities fit into
// one set together with their standard errors. If there are more, their values fill sets of four, and so do their
// standard errors. Numbers that a table does not hold are 0 here.
struct NodeRecords {
  explicit NodeRecords(const Table& table);

  // The maximum number of sets of a table: three quantities over one number of axes, six over the other.
  static constexpr std::size_t kMaxSets = 6;
  static_assert(kMaxQuantities == 9 && kRecordSize == 4);

  struct Set {
    bool over_last_axis;
    Records numbers;  // Of a variable on a log scale, the logarithms of its values.
    Records plain;    // The values as the table holds them, if any of `numbers` is a logarithm; else empty.
  };
  std::vector<Set> sets;
  std::size_t quantity_count;
  std::array<RecordPlace, kMaxQuantities> values, standard_errors;
  std::array<bool, kMaxQuantities> has_values{}, has_standard_errors{}, is_log{};
};

}  // namespace albtpu
