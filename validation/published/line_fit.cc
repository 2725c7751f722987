#include "validation/published/line_fit.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>

namespace albtpu {

LineFit FitLine(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() == y.size() && x.size() >= 2);
  const auto count = static_cast<Eigen::Index>(x.size());
  const Eigen::ArrayXd xs = Eigen::Map<const Eigen::ArrayXd>(x.data(), count);
  const Eigen::ArrayXd ys = Eigen::Map<const Eigen::ArrayXd>(y.data(), count);
  const Eigen::ArrayXd dx = xs - xs.mean(), dy = ys - ys.mean();
  const double slope = (dx * dy).sum() / dx.square().sum();
  return {slope, ys.mean() - slope * xs.mean(), slope * (dx * dy).sum() / dy.square().sum()};
}

PowerLaw FitPowerLaw(std::vector<double> x, std::vector<double> y) {
  for (double& value : x) value = std::log(value);
  for (double& value : y) value = std::log(value);
  const LineFit line = FitLine(x, y);
  return {std::exp(line.intercept), line.slope};
}

}  // namespace albtpu
