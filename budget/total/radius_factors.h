// RadiusFactor95 (tables/coverage.h) for loops over many pulses.
#pragma once

#include <array>

#include "tables/coverage.h"

namespace albtpu {

class RadiusFactors {
 public:
  static const RadiusFactors& Get() {
    static const RadiusFactors factors;
    return factors;
  }

  // `axis_ratio` in [0, 1]. Errors below 2e-7.
  float operator()(float axis_ratio) const {
    const float position = axis_ratio * kIntervals;
    const int lower = static_cast<int>(position);
    return factors_[lower] + (position - static_cast<float>(lower)) * (factors_[lower + 1] - factors_[lower]);
  }

 private:
  static constexpr int kIntervals = 1024;

  RadiusFactors() {
    for (int i = 0; i <= kIntervals; ++i)
      factors_[i] = static_cast<float>(RadiusFactor95(static_cast<double>(i) / kIntervals));
    factors_[kIntervals + 1] = factors_[kIntervals];
  }

  std::array<float, kIntervals + 2> factors_;
};

}  // namespace albtpu
