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

}  // namespace

Estimate Mean(const Eigen::ArrayXd& sample) {
  const double n = static_cast<double>(sample.size());
  assert(n >= 2);
  const double mean = sample.mean();
  return {mean, std::sqrt((sample - mean).square().sum() / (n - 1) / n)};
}

Estimate TwoSigma(const Eigen::ArrayXd& sample) {
  return TwoSigmaOfSquares((sample - sample.mean()).square());
}

Estimate TwoSigma(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  return TwoSigmaOfSquares((x - x.mean()).square() + (y - y.mean()).square());
}

}  // namespace albtpu
