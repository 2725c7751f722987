// Answers for many pulses at a time: the engine behind the server, the client's --table and C++ users.
#pragma once

#include <cstddef>
#include <memory>

#include "tables/query/interpolation.h"
#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// A table laid out for speed. Immutable; may be used by any number of threads at a time.
//
// Its answers are those of `Interpolate` (interpolation.h), its slow twin in double precision, with the same
// outcomes and axes: at nodes bit for bit, between them within 1e-5, relative, or within 4e-7 of the largest corner
// where corners cancel. The answer for a pulse depends on this pulse and the instruction set alone, not on its
// neighbours, its place or the number of pulses. Along a flight line, where neighbours share a cell of the table,
// it is some seven times as fast as in random order; thousands of pulses in random order are sorted on the way.
//
// Example, a flight line at a wind of 5 m/s:
//   const absl::StatusOr<UncertaintyTable> table = ReadTable("survey.h5");
//   const ColumnInterpolator interpolator(*table);
//   const float wind_speed = 5, footprint = 0.5f;
//   std::vector<float> incidence = ..., depth = ...;  // of each pulse
//   PulseColumns pulses{.size = depth.size()};
//   pulses.axis = {std::span(&wind_speed, 1), {}, incidence, {}, std::span(&footprint, 1), depth};
//   std::vector<float> thu(pulses.size), tvu(pulses.size);
//   AnswerColumns answers;
//   answers.values[Index(Quantity::kThu)] = thu.data();
//   answers.values[Index(Quantity::kTvu)] = tvu.data();
//   InterpolateOnAllCores(interpolator, {.coverage = Coverage::kP95}, pulses, answers);
class ColumnInterpolator {
 public:
  // `table` need not outlive it.
  explicit ColumnInterpolator(const UncertaintyTable& table);
  ~ColumnInterpolator();
  ColumnInterpolator(ColumnInterpolator&&) noexcept;
  ColumnInterpolator& operator=(ColumnInterpolator&&) noexcept;

  // Answers the pulses from `begin` to `end`, `end` not included, into the same rows of `answers`, on the calling
  // thread. `pulses` must be valid. Allocates nothing, except at most 7 MB to sort pulses.
  void Interpolate(const Query& query, const PulseColumns& pulses, std::size_t begin, std::size_t end,
                   const AnswerColumns& answers) const;

 private:
  struct Layout;
  std::unique_ptr<const Layout> layout_;
};

// Answers all pulses: on all cores if there are enough pulses for that to be faster, else on the calling thread.
void InterpolateOnAllCores(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses,
                           const AnswerColumns& answers);

}  // namespace albtpu
