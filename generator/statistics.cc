#include "generator/statistics.h"

#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

// `squares` are squared deviations from the sample's mean: their sum over n - 1 is the variance V, and the
// standard error of 2 sqrt(V) is that of V over sqrt(V).
Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares) {
  const double n = static_cast<double>(squares.size());
  assert(n >= 2);
  const double variance = squares.sum() / (n - 1);
  if (variance <= 0) return {};
  const double scatter = (squares - squares.mean()).square().sum() / (n - 1);
  return {2 * std::sqrt(variance), std::sqrt(scatter / n / variance)};
}

constexpr Eigen::Index kFewestToFit = 64;  // realizations; with fewer the fit hides some of the scatter

// The slope of a straight line through (x, y), zero where x does not scatter.
double Slope(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::ArrayXd deviation = x - x.mean();
  const double scatter = deviation.square().sum();
  return scatter > 0 ? (deviation * y).sum() / scatter : 0;
}

Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& of_control,
                           double variance_of_control) {
  const Eigen::Index n = squares.size(), half = n / 2;
  if (n < kFewestToFit) return TwoSigmaOfSquares(squares);
  double variance = 0, scatter = 0;
  for (const bool first : {true, false}) {
    const Eigen::Index begin = first ? 0 : half, count = first ? half : n - half;
    const Eigen::Index other = first ? half : 0, others = n - count;
    const double b = Slope(of_control.segment(other, others), squares.segment(other, others));
    const Eigen::ArrayXd rest = squares.segment(begin, count) - b * of_control.segment(begin, count);
    variance += rest.sum() / (n - 1) + b * variance_of_control * count / n;
    scatter += (rest - rest.mean()).square().sum() / (n - 2);
  }
  if (variance <= 0) return TwoSigmaOfSquares(squares);
  return {2 * std::sqrt(variance), std::sqrt(scatter / n / variance)};
}

Eigen::ArrayXd SquaredDeviations(const Eigen::ArrayXd& sample) { return (sample - sample.mean()).square(); }

Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, const std::optional<Control>& control) {
  if (!control) return TwoSigmaOfSquares(squares);
  Eigen::ArrayXd of_control = SquaredDeviations(control->sample);
  if (control->second.size() > 0) of_control += SquaredDeviations(control->second);
  return TwoSigmaOfSquares(squares, of_control, control->variance);
}

}  // namespace

Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control) {
  const double n = static_cast<double>(sample.size());
  assert(n >= 2);
  const Eigen::ArrayXd rest = control ? Eigen::ArrayXd(sample - control->sample) : sample;
  const double standard_error = std::sqrt((rest - rest.mean()).square().sum() / (n - 1) / n);
  return {rest.mean() + (control ? control->mean : 0), standard_error};
}

Estimate TwoSigma(const Eigen::ArrayXd& sample, const std::optional<Control>& control) {
  return TwoSigmaOfSquares(SquaredDeviations(sample), control);
}

Estimate TwoSigma(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, const std::optional<Control>& control) {
  return TwoSigmaOfSquares(SquaredDeviations(x) + SquaredDeviations(y), control);
}

}  // namespace albtpu
