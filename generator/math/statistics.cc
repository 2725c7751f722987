#include "generator/math/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

constexpr Eigen::Index kFewestToFit = 64;  // realizations; with fewer, the fit absorbs part of the scatter

// The least-squares slope of y over x, zero where x is constant.
double Slope(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::ArrayXd deviation = x - x.mean();
  const double scatter = deviation.square().sum();
  return scatter > 0 ? (deviation * y).sum() / scatter : 0;
}

// The squares less b times the excess of the control over its expectation. Each half of the sample takes b from the
// regression over the other half: b is then independent of what it multiplies, and the corrected mean is unbiased.
Eigen::ArrayXd Corrected(const Eigen::ArrayXd& squares, const Control& control) {
  const Eigen::Index n = squares.size(), half = n / 2;
  const Eigen::ArrayXd excess = control.sample - control.expectation;
  Eigen::ArrayXd corrected(n);
  for (const bool first : {true, false}) {
    const Eigen::Index begin = first ? 0 : half, count = first ? half : n - half;
    const Eigen::Index other_begin = first ? half : 0, other_count = n - count;
    const double b = Slope(excess.segment(other_begin, other_count), squares.segment(other_begin, other_count));
    corrected.segment(begin, count) = squares.segment(begin, count) - b * excess.segment(begin, count);
  }
  return corrected;
}

// The variance about the mean of each half: b, and with it the mean, differs between the halves.
double VarianceWithinHalves(const Eigen::ArrayXd& sample) {
  const Eigen::Index n = sample.size(), half = n / 2;
  const auto first = sample.head(half), second = sample.tail(n - half);
  return ((first - first.mean()).square().sum() + (second - second.mean()).square().sum()) / (n - 2);
}

}  // namespace

Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control) {
  const double n = static_cast<double>(sample.size());
  assert(n >= 2);
  const Eigen::ArrayXd residual = control ? Eigen::ArrayXd(sample - control->sample) : sample;
  const double standard_error = std::sqrt((residual - residual.mean()).square().sum() / (n - 1) / n);
  return {residual.mean() + (control ? control->expectation : 0), standard_error};
}

// d(2 sqrt(V)) = dV / sqrt(V): the standard error of 2 sqrt(V) is that of V over sqrt(V).
Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, double mean_correction,
                           const std::optional<Control>& control) {
  const double n = static_cast<double>(squares.size());
  assert(n >= 2);
  if (control && squares.size() >= kFewestToFit) {
    const Eigen::ArrayXd corrected = Corrected(squares, *control);
    const double variance = corrected.mean() + mean_correction;
    if (variance > 0) return {2 * std::sqrt(variance), std::sqrt(VarianceWithinHalves(corrected) / n / variance)};
  }
  const double variance = squares.mean() + mean_correction;
  if (variance <= 0) return {};
  const double scatter = (squares - squares.mean()).square().sum() / (n - 1);
  return {2 * std::sqrt(variance), std::sqrt(scatter / n / variance)};
}

Estimate TwoSigma(const Eigen::ArrayXd& sample) {
  const double n = static_cast<double>(sample.size());
  assert(n >= 2);
  const Eigen::ArrayXd squares = (sample - sample.mean()).square();
  return TwoSigmaOfSquares(squares, squares.sum() / (n - 1) / n);
}

namespace {

// The binary exponent of the last of `bits` significant digits.
int LastDigit(double value, int bits) { return std::ilogb(value) + 1 - bits; }

// Adding zero turns -0 into +0.
double RoundToMultiple(double value, int exponent) {
  return std::ldexp(std::nearbyint(std::ldexp(value, -exponent)), exponent) + 0.0;
}

}  // namespace

double RoundToBits(double value, int bits) {
  assert(bits >= 1 && bits <= 24 && std::isfinite(value));
  return value == 0 ? 0 : RoundToMultiple(value, LastDigit(value, bits));
}

Estimate Rounded(const Estimate& estimate) {
  assert(estimate.standard_error >= 0);
  const double value = estimate.value, error = RoundToBits(estimate.standard_error, kStandardErrorBits);
  if (value == 0 || error == 0) return {RoundToBits(value, kValueBits), error};
  const int quarter_of_error = std::ilogb(error) - 2;
  return {RoundToMultiple(value, std::max(LastDigit(value, kValueBits), quarter_of_error)), error};
}

}  // namespace albtpu
