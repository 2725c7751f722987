// Many pulses and their answers as columns of single-precision numbers in memory of the caller.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "absl/status/status.h"
#include "tables/coverage.h"
#include "tables/pulse.h"
#include "tables/s44.h"
#include "tables/schema.h"

namespace albtpu {

static_assert(std::endian::native == std::endian::little, "columns are copied to and from the wire unchanged");

// Pulses as one column for each axis, in the units of the axes. A column has `size` numbers, or one for all pulses.
// The columns of fetch and azimuth may be empty, which means a fully developed sea and the worse of 0 and 90
// degrees; the others only if there are no pulses. For a table of one sea, those of wind speed, fetch and azimuth may
// be empty, the last of which means the worst azimuth. For a table of another kind, columns are in the order of its
// axes, and AxisSchema says which may be empty.
struct PulseColumns {
  std::size_t size = 0;
  std::array<std::span<const float>, kMaxAxes> axis;
  static_assert(kAxisCount <= kMaxAxes);

  std::span<const float> operator[](AxisId id) const { return axis[Index(id)]; }
};

// InvalidArgument, naming the first column whose length `PulseColumns` does not allow; of the sea surface, or of
// the kind that `schema` describes.
absl::Status CheckLengths(const PulseColumns& pulses);
absl::Status CheckLengths(const TableSchema& schema, const PulseColumns& pulses);

// `count` pulses from `begin` on.
PulseColumns Slice(const PulseColumns& pulses, std::size_t begin, std::size_t count);

// The pulse at index `i`.
Pulse PulseAt(const PulseColumns& pulses, std::size_t i);

// How to state the answers. The columns that are not null say which answers are wanted.
struct Query {
  Coverage coverage = Coverage::kTwoSigma;
  // The order of `remaining_thu` and `remaining_tvu`, which are NaN without it.
  std::optional<S44Order> s44_order;
};

// Where to write answers: columns of as many elements as there are pulses, or null if an answer is not wanted.
// Numbers are at the coverage of the query, and NaN where there is none.
struct AnswerColumns {
  std::uint8_t* outcomes = nullptr;      // 1 interpolated, 2 out of domain, 3 invalid: Outcome + 1
  std::uint8_t* outcome_axes = nullptr;  // AxisId + 1 of the axis that made the outcome; 0 if interpolated
  std::array<float*, kQuantityCount> values{};
  std::array<float*, kQuantityCount> standard_errors{};
  std::uint8_t* best_s44_orders = nullptr;  // S44Order + 1; 0 if no order is left open or there is no number
  float* remaining_thu = nullptr;           // m at 95 %, for the order of the query
  float* remaining_tvu = nullptr;           // m at 95 %, for the order of the query
};

}  // namespace albtpu
