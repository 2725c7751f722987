// Answers for many pulses at a time: the one engine behind the server, the client's --table and C++ users.
#pragma once

#include <cstddef>
#include <memory>

#include "tables/query/interpolation.h"  // Users of this header have always had it too.
#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// A table laid out for speed. Immutable; used by any number of threads at a time.
//
// Answers are those of `Interpolate` (interpolation.h), its slow double precision twin: the same outcomes and
// axes, at nodes the same bits, between them the same numbers within 1e-5, relative, and where corners cancel
// within 4e-7 of the largest. What a pulse is answered depends on this pulse and the instruction set alone: not
// on its neighbours, its place or the number of pulses. Along a flight line, where neighbours share a cell of
// the table, answers come some seven times as fast as in no order: thousands in no order are sorted on the way.
//
// Example, a flight line in a wind of 5 m/s:
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
//   AnswerOnAllCores(interpolator, {.coverage = Coverage::kP95}, pulses, answers);
class ColumnInterpolator {
 public:
  // `table` need not outlive it.
  explicit ColumnInterpolator(const UncertaintyTable& table);
  ~ColumnInterpolator();
  ColumnInterpolator(ColumnInterpolator&&) noexcept;
  ColumnInterpolator& operator=(ColumnInterpolator&&) noexcept;

  // Answers the pulses `begin` to `end`, `end` not included, into the same rows of `answers`, on the thread
  // that calls. `pulses` must be valid. Allocates nothing but, to sort, 7 MB at the most.
  void Answer(const Query& query, const PulseColumns& pulses, std::size_t begin, std::size_t end,
              const AnswerColumns& answers) const;

 private:
  struct Layout;
  std::unique_ptr<const Layout> layout_;
};

// Answers all pulses: on all cores where there are enough of them to gain by it, else on this thread.
void AnswerOnAllCores(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses,
                      const AnswerColumns& answers);

}  // namespace albtpu
