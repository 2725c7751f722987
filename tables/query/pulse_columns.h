// Many pulses and their answers as columns of single precision numbers, in memory of the caller.
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

static_assert(std::endian::native == std::endian::little, "columns go to and from the wire as they are");

// Pulses, a column an axis, in the units of the axes. A column has `size` numbers, or one for all pulses, or
// none: of the fetch that is the fully developed sea, of the azimuth the worse of 0 and 90 degrees. The other
// columns must not be empty where there are pulses.
struct PulseColumns {
  std::size_t size = 0;
  std::array<std::span<const float>, kAxisCount> axis;

  std::span<const float> operator[](AxisId id) const { return axis[Index(id)]; }
};

// InvalidArgument, naming the first column whose length is not one that `PulseColumns` allows.
absl::Status CheckLengths(const PulseColumns& pulses);

// The pulse at `i`.
Pulse PulseAt(const PulseColumns& pulses, std::size_t i);

// How answers are to be given. Which of them, the columns tell that are not null.
struct Query {
  Coverage coverage = Coverage::kTwoSigma;
  std::optional<S44Order> s44_order;  // What `remaining_thu` and `remaining_tvu` are of; NaN without.
};

// Where to write answers: columns of as many elements as there are pulses; null what is not wanted. Numbers
// are not-a-number where there is none, at the coverage of the query.
struct AnswerColumns {
  std::uint8_t* outcomes = nullptr;      // 1 interpolated, 2 out of domain, 3 invalid: Outcome + 1
  std::uint8_t* outcome_axes = nullptr;  // AxisId + 1 of the axis that made the outcome; 0 if interpolated
  std::array<float*, kQuantityCount> values{};
  std::array<float*, kQuantityCount> standard_errors{};
  std::uint8_t* best_s44_orders = nullptr;  // S44Order + 1; 0 where none is left open or there is no number
  float* remaining_thu = nullptr;           // m at 95 %, of the order of the query
  float* remaining_tvu = nullptr;           // m at 95 %, of the order of the query
};

}  // namespace albtpu
