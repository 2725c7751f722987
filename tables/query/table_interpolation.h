// Multilinear interpolation in a table of any kind: pulse by pulse in double precision, and fast for many pulses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "tables/pulse.h"
#include "tables/query/pulse_columns.h"
#include "tables/table.h"

namespace albtpu {

// The answer for one pulse, at the indices of the schema. NaN wherever there is no number.
struct TableValues {
  Outcome outcome = Outcome::kInvalid;
  std::optional<std::size_t> axis;  // The first axis that caused the outcome; none if interpolated.
  std::array<float, kMaxQuantities> values;
  std::array<float, kMaxQuantities> standard_errors;  // Interpolated linearly.
  std::optional<Side> side;  // On which side of `axis` the pulse is, if it is out of domain: SideOf.
};

// At one coordinate for each axis of the table.
TableValues InterpolateAt(const Table& table, std::span<const double> coordinates);

// The same where coordinates may be absent (IfAbsent). At an axis with alternatives (Axis::alternatives), each value is
// the largest in magnitude, with its standard error; without numbers at all of them there are none.
TableValues Interpolate(const Table& table, std::span<const std::optional<float>> coordinates);

// Where to write answers: columns of as many elements as there are pulses, at the indices of the schema; null what
// is not wanted, and beyond the quantities of the schema.
struct ValueColumns {
  std::uint8_t* outcomes = nullptr;      // 1 interpolated, 2 out of domain, 3 invalid: Outcome + 1
  std::uint8_t* outcome_axes = nullptr;  // index + 1 of the axis that made the outcome; 0 if interpolated
  std::array<float*, kMaxQuantities> values{};
  std::array<float*, kMaxQuantities> standard_errors{};
};

// A table laid out for speed. Its answers are those of `Interpolate`, with the same outcomes and axes: at nodes bit
// for bit, between them within 1e-5, relative, or within 4e-7 of the largest corner where corners cancel.
// Immutable; may be used by any number of threads at a time.
class TableInterpolator {
 public:
  // `table` need not outlive it, but its schema must.
  explicit TableInterpolator(const Table& table);
  ~TableInterpolator();
  TableInterpolator(TableInterpolator&&) noexcept;
  TableInterpolator& operator=(TableInterpolator&&) noexcept;

  // Answers the pulses from `begin` to `end`, `end` not included, into the same rows of `answers`, on the calling
  // thread. `pulses` must be valid: CheckLengths(schema, pulses).
  void Interpolate(const PulseColumns& pulses, std::size_t begin, std::size_t end,
                   const ValueColumns& answers) const;

 private:
  struct Layout;
  std::unique_ptr<const Layout> layout_;
};

}  // namespace albtpu
