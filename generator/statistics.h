// From a sample of realizations to estimates with standard errors.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace albtpu {

struct Estimate {
  double value = 0;
  double standard_error = 0;
};

// A control variate: something that is nearly proportional to what is estimated, in each realization, and of which
// the expectation is known.
struct Control {
  Eigen::ArrayXd sample;  // of one component, or
  Eigen::ArrayXd second;  // empty, or of another one
  double mean = 0;        // expectation of `sample`
  double variance = 0;    // the summed variances of the components
};

// The mean; with a control, the known mean of that and the sample's mean difference from it.
Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control = {});

// Twice the standard deviation. Its standard error comes from the scatter of the squared deviations
// themselves, so that it holds for distributions that are not normal (vertical errors at nadir are closer to
// chi-squared). Zero for a sample that does not scatter.
//
// With a control it comes from the known variance of that and from the difference between the sample's squared
// deviations and b times the control's. b is fitted to the other half of the sample, so that the estimate is
// unbiased; with fewer than 64 realizations there is nothing to fit it to, b = 0.
Estimate TwoSigma(const Eigen::ArrayXd& sample, const std::optional<Control>& control = {});

// Twice the root of the summed variances of the two components.
Estimate TwoSigma(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y,
                  const std::optional<Control>& control = {});

}  // namespace albtpu
