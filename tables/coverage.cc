#include "tables/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kOutside = 0.05;  // The probability of lying outside a 95 % interval or radius.

// The probability that a centred normal point with standard deviations 1 and `axis_ratio` lies beyond `radius`, and
// its derivative with respect to the radius. Write the point as x = rho cos t, y = axis_ratio rho sin t: rho has a
// Rayleigh distribution and t a uniform one, so that the probability is the mean over t of exp(-radius^2 / (2 w)),
// w = cos^2 t + axis_ratio^2 sin^2 t. The integrand is smooth and periodic, so that a sum over equal steps
// converges exponentially.
struct Tail {
  double probability;
  double slope;
};

Tail TailBeyond(double radius, double axis_ratio) {
  constexpr int kSteps = 64;  // Midpoints over a quarter turn, where w is never 0.
  Tail tail{0, 0};
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * std::numbers::pi / (2 * kSteps);
    const double w = std::pow(std::cos(t), 2) + std::pow(axis_ratio * std::sin(t), 2);
    const double p = std::exp(-radius * radius / (2 * w));
    tail.probability += p / kSteps;
    tail.slope -= p * radius / w / kSteps;
  }
  return tail;
}

double SolveRadiusFactor95(double axis_ratio) {
  double radius = 2;
  for (int i = 0; i < 6; ++i) {  // Newton's method; from 2, five steps reach 1e-14 for every axis ratio.
    const Tail tail = TailBeyond(radius, axis_ratio);
    radius -= (tail.probability - kOutside) / tail.slope;
  }
  return radius / (2 * std::hypot(1.0, axis_ratio));
}

// The factor at equal steps of the axis ratio. Its second derivative is below 0.73, so that the error of linear
// interpolation between the nodes is below 0.73 / 8 / kIntervals^2 = 9e-8.
constexpr int kIntervals = 1024;
using RadiusFactors = std::array<double, kIntervals + 1>;

const RadiusFactors& PrecomputedRadiusFactors() {
  static const RadiusFactors factors = [] {
    RadiusFactors f;
    for (int i = 0; i <= kIntervals; ++i) f[i] = SolveRadiusFactor95(static_cast<double>(i) / kIntervals);
    return f;
  }();
  return factors;
}

double AxisRatio(double a, double b) {
  const double larger = std::max(a, b);
  return larger > 0 ? std::min(a, b) / larger : 0;
}

}  // namespace

double RadiusFactor95(double axis_ratio) {
  const RadiusFactors& factors = PrecomputedRadiusFactors();
  const double position = std::clamp(axis_ratio, 0.0, 1.0) * kIntervals;
  const int lower = std::min(static_cast<int>(position), kIntervals - 1);
  return factors[lower] + (position - lower) * (factors[lower + 1] - factors[lower]);
}

double RadiusOverThu(const std::array<float, kQuantityCount>& values) {
  return RadiusFactor95(
      AxisRatio(values[Index(Quantity::kRefractionAlongWind)], values[Index(Quantity::kRefractionCrossWind)]));
}

double LargerRadiusOverThu(double thu_a, double radius_over_thu_a, double thu_b, double radius_over_thu_b) {
  const double radius_a = radius_over_thu_a * thu_a, radius_b = radius_over_thu_b * thu_b;
  if (thu_a >= thu_b) return radius_a >= radius_b ? radius_over_thu_a : radius_b / thu_a;
  return radius_b >= radius_a ? radius_over_thu_b : radius_a / thu_b;
}

PulseUncertainty WithCoverage(PulseUncertainty uncertainty, Coverage coverage) {
  if (coverage == Coverage::kTwoSigma || uncertainty.outcome != Outcome::kInterpolated) return uncertainty;
  for (Quantity quantity : kQuantities) {
    if (Describe(quantity).is_bias) continue;
    const double factor = coverage == Coverage::kOneSigma ? 0.5
                          : quantity == Quantity::kThu    ? uncertainty.radius_over_thu
                                                          : kFactor95;
    float& value = uncertainty.values[Index(quantity)];
    float& standard_error = uncertainty.standard_errors[Index(quantity)];
    value = static_cast<float>(value * factor);
    standard_error = static_cast<float>(standard_error * factor);
  }
  return uncertainty;
}

}  // namespace albtpu
