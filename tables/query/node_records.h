// The numbers of a table, laid out to be blended.
#pragma once

#include <array>
#include <cstddef>

#include "tables/query/record_blend.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// In records of 4 numbers. What a table does not hold is 0 here. On a log scale, values are logarithms.
struct NodeRecords {
  explicit NodeRecords(const UncertaintyTable& table);

  Records refraction;           // no depth: along and cross wind, standard errors of both
  Records displacement;         // THU, TVU, bias along the beam, vertical bias
  Records displacement_errors;  // the standard errors of these; empty if there are none
  // As the table has them, where any is a logarithm above; else empty.
  Records plain_refraction, plain_displacement;

  std::array<std::size_t, kAxisCount> nodes;
  std::array<bool, kQuantityCount> has_values, has_standard_errors, is_log;
};

// Where a quantity stands.
struct RecordPlace {
  bool is_refraction;
  std::size_t value;           // in the record
  std::size_t standard_error;  // in the record of `refraction` or of `displacement_errors`
};
constexpr RecordPlace PlaceOf(Quantity quantity) {
  constexpr std::size_t kRefractions = 2;
  const std::size_t q = Index(quantity);
  if (q < kRefractions) return {true, q, q + kRefractions};
  return {false, q - kRefractions, q - kRefractions};
}

}  // namespace albtpu
