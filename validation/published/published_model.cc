#include "validation/published/published_model.h"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>

namespace albtpu {

double PublishedAlongWindDiameterFactor(double diameter) {
  return std::pow(diameter / 0.25, kPublishedAlongWindExponent);
}

double PublishedCrossWindDiameterFactor(double diameter) {
  return std::pow(diameter / 0.25, kPublishedCrossWindExponent);
}

AngleModel FitAngleModel(const std::vector<AngleSample>& samples) {
  assert(samples.size() >= 4);
  const auto count = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixX4d terms(count, 4);
  Eigen::VectorXd angles(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AngleSample& sample = samples[i];
    terms.row(i) << sample.incidence_degrees * sample.wind_speed, sample.wind_speed, sample.incidence_degrees,
        1;
    angles[i] = sample.angle_degrees;
  }
  const Eigen::Vector4d fit = terms.colPivHouseholderQr().solve(angles);
  return {fit[0], fit[1], fit[2], fit[3]};
}

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
