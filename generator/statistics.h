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

// A control variate: something that is nearly proportional to what is estimated, in each realization, and of which
// the expectation is known.
struct Control {
  Eigen::ArrayXd sample;  // of one component, or
  Eigen::ArrayXd second;  // empty, or of another one
  double mean = 0;        // expectation of `sample`
  double variance = 0;    // the summed variances of the components, exactly
};

// The same as TwoSigma(x) and TwoSigma(x, y), from the known variance of the control and the sample's difference
// between its squared deviations and b times those of the control. b is fitted to the other half of the sample,
// so that the estimate is unbiased; with fewer than 32 realizations there is nothing to fit it to, b = 0.
Estimate TwoSigma(const Eigen::ArrayXd& sample, const Control& control);
Estimate TwoSigma(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, const Control& control);

// The mean of the sample, from the known mean of the control and the sample's mean difference from it.
Estimate Mean(const Eigen::ArrayXd& sample, const Control& control);

}  // namespace albtpu
