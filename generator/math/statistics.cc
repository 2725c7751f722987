#include "generator/math/statistics.h"

#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

constexpr Eigen::Index kFewestToFit = 64;  // realizations; with fewer the fit hides some of the scatter

// The slope of a straight line through (x, y), zero where x does not scatter.
double Slope(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::ArrayXd deviation = x - x.mean();
  const double scatter = deviation.square().sum();
  return scatter > 0 ? (deviation * y).sum() / scatter : 0;
}

// What is left of the squares when each half of the sample is corrected by the control as the other half says.
Eigen::ArrayXd Corrected(const Eigen::ArrayXd& squares, const Control& control) {
  const Eigen::Index n = squares.size(), half = n / 2;
  const Eigen::ArrayXd excess = control.sample - control.expectation;
  Eigen::ArrayXd corrected(n);
  for (const bool first : {true, false}) {
    const Eigen::Index begin = first ? 0 : half, count = first ? half : n - half;
    const Eigen::Index other = first ? half : 0, others = n - count;
    const double b = Slope(excess.segment(other, others), squares.segment(other, others));
    corrected.segment(begin, count) = squares.segment(begin, count) - b * excess.segment(begin, count);
  }
  return corrected;
}

// The scatter of a sample about the means of its halves: b differs from one to the other.
double ScatterInHalves(const Eigen::ArrayXd& sample) {
  const Eigen::Index n = sample.size(), half = n / 2;
  const auto first = sample.head(half), second = sample.tail(n - half);
  return ((first - first.mean()).square().sum() + (second - second.mean()).square().sum()) / (n - 2);
}

}  // namespace

Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control) {
  const double n = static_cast<double>(sample.size());
  assert(n >= 2);
  const Eigen::ArrayXd rest = control ? Eigen::ArrayXd(sample - control->sample) : sample;
  const double standard_error = std::sqrt((rest - rest.mean()).square().sum() / (n - 1) / n);
  return {rest.mean() + (control ? control->expectation : 0), standard_error};
}

// The standard error of 2 sqrt(V) is that of V over sqrt(V).
Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, double of_mean,
                           const std::optional<Control>& control) {
  const double n = static_cast<double>(squares.size());
  assert(n >= 2);
  if (control && squares.size() >= kFewestToFit) {
    const Eigen::ArrayXd corrected = Corrected(squares, *control);
    const double variance = corrected.mean() + of_mean;
    if (variance > 0) return {2 * std::sqrt(variance), std::sqrt(ScatterInHalves(corrected) / n / variance)};
  }
  const double variance = squares.mean() + of_mean;
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

}  // namespace albtpu
