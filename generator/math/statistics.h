// From a sample of realizations to estimates with standard errors.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace albtpu {

struct Estimate {
  double value = 0;
  double standard_error = 0;
};

// A control variate: something that goes with what is averaged, realization by realization, and of which the
// expectation is known.
struct Control {
  Eigen::ArrayXd sample;
  double expectation = 0;
};

// The mean; with a control, the expectation of that and the sample's mean difference from it.
Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control = {});

// Twice the root of a variance, from the squared deviations of each realization from a mean that the same
// realizations gave, with `of_mean` to make up for that. The standard error comes from the scatter of the squares
// themselves, so that it holds for distributions that are not normal (vertical errors at nadir are closer to
// chi-squared). Zero for a sample that does not scatter.
//
// With a control of the squares it is the expectation of that times b and the mean difference between the
// squares and b times the control. b is fitted to the other half of the sample, so that the variance is
// unbiased; with fewer than 64 realizations there is nothing to fit it to, b = 0. Where the correction leaves no
// variance, as chance may where there is next to none, the control is left alone too.
Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, double of_mean,
                           const std::optional<Control>& control = {});

// Twice the standard deviation of a sample.
Estimate TwoSigma(const Eigen::ArrayXd& sample);

}  // namespace albtpu
