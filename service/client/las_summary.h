// What was found in a LAS file and what was answered, for people: counts, and uncertainty by depth beside
// S-44.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "service/client/answer_columns.h"
#include "service/client/las_point.h"
#include "service/client/outcome_counts.h"
#include "tables/interpolation.h"
#include "tables/s44.h"

namespace albtpu::client {

class LasSummary {
 public:
  explicit LasSummary(AnswerStyle style) : style_(style) {}

  void AddPoint(int point_class) { ++class_counts_[point_class]; }
  // `two_sigma` as the table has it, `stated` in the coverage asked for.
  void AddPulse(const Pulse& pulse, const PulseUncertainty& two_sigma, const PulseUncertainty& stated);

  std::uint64_t points() const;
  const OutcomeCounts& outcomes() const { return outcomes_; }

  // "class 1: 12345 points, class 26: 4321": what --classes can be given.
  std::string ClassesText() const;

  // Several lines.
  std::string Text() const;

 private:
  // Upper ends of the bands, m; the last band is open.
  static constexpr std::array<double, 9> kBandEnds = {0.25, 1, 2, 5, 10, 15, 20, 30, 50};

  struct Band {
    std::uint64_t count = 0, within_order = 0;
    double thu_sum = 0, thu_max = 0, tvu_sum = 0, tvu_max = 0;
    double thu_error_sum = 0, tvu_error_sum = 0;
  };

  S44Order order() const { return style_.s44_order.value_or(S44Order::k1b); }
  std::string BandText(std::size_t band) const;

  AnswerStyle style_;
  std::array<std::uint64_t, kClassCount> class_counts_ = {};
  OutcomeCounts outcomes_;
  std::array<Band, kBandEnds.size() + 1> bands_ = {};
  double least_depth_ = 0, greatest_depth_ = 0;  // Of pulses with an uncertainty.
};

}  // namespace albtpu::client
