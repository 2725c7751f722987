// What follows from a total covariance: the ellipse and the 95 % radius of its horizontal part, and the orders of S-44
// that are met.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "tables/coverage.h"
#include "tables/s44.h"

namespace albtpu {

// The ellipse of a horizontal covariance.
struct HorizontalEllipse {
  double semi_major, semi_minor;  // m, 1 sigma.
  double major_azimuth;           // degree from north, clockwise, 0 to 180; 0 of a circle.
};

// Of variances to the north and east and their covariance, m^2.
inline HorizontalEllipse EllipseOf(double nn, double ee, double ne) {
  const double mean = (nn + ee) / 2, split = std::hypot((nn - ee) / 2, ne);
  const double turn = split > 0 ? std::atan2(2 * ne, nn - ee) * (90 / std::numbers::pi) : 0;
  return {std::sqrt(mean + split), std::sqrt(std::max(mean - split, 0.0)), turn < 0 ? turn + 180 : turn};
}

// RadiusFactor95 (tables/coverage.h) for loops over many pulses.

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

// The horizontal uncertainty of a covariance at each coverage, m: of variances and their covariance, m^2.
class HorizontalRadius {
 public:
  HorizontalRadius(double xx, double yy, double xy) {
    const double mean = (xx + yy) / 2, split = std::hypot((xx - yy) / 2, xy);
    root_of_trace_ = std::sqrt(2 * mean);
    axis_ratio_ = mean > 0 ? std::sqrt(std::clamp((mean - split) / (mean + split), 0.0, 1.0)) : 0;
  }

  double At(Coverage coverage) const {
    if (coverage == Coverage::kOneSigma) return root_of_trace_;
    const double two_sigma = 2 * root_of_trace_;
    return coverage == Coverage::kTwoSigma ? two_sigma
                                           : two_sigma * RadiusFactors::Get()(static_cast<float>(axis_ratio_));
  }

 private:
  double root_of_trace_, axis_ratio_;
};

// The orders of S-44 that a total uncertainty meets.

// 1 plus the number of the strictest order (kS44Orders) whose limits exceed `thu` and `tvu`, both at 95 %, each plus
// the magnitude of the bias that was not corrected: U = k sigma + |b|, Guide to the Expression of Uncertainty in
// Measurement (JCGM 100:2008), F.2.4.5. 0 if there is none, or a number is NaN. All in m.
inline std::uint8_t BestOrderMet(double thu, double tvu, double bias_along_beam, double bias_vertical, double depth) {
  const std::optional<S44Order> order =
      BestOrder(thu + std::abs(bias_along_beam), tvu + std::abs(bias_vertical), depth);
  return order.has_value() ? static_cast<std::uint8_t>(static_cast<int>(*order) + 1) : 0;
}

}  // namespace albtpu
