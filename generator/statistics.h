// From a sample of realizations to estimates with standard errors.
#pragma once

#include <Eigen/Core>

namespace albtpu {

struct Estimate {
  double value = 0;
  double standard_error = 0;
};

Estimate Mean(const Eigen::ArrayXd& sample);

// Twice the standard deviation. Its standard error comes from the scatter of the squared deviations
// themselves, so that it holds for distributions that are not normal (vertical errors at nadir are closer to
// chi-squared). Zero for a sample that does not scatter.
Estimate TwoSigma(const Eigen::ArrayXd& sample);

// Twice the root of the summed variances of the two components.
Estimate TwoSigma(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y);

}  // namespace albtpu
