// Estimates with standard errors from a sample of realizations, and their rounding for storage.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sea/angle.h"

namespace albtpu {

struct Estimate {
  double value = 0;
  double standard_error = 0;
};

inline Estimate InDegrees(const Estimate& radians) {
  return {DegreesOfRadians(radians.value), DegreesOfRadians(radians.standard_error)};
}

// A control variate: a quantity that correlates with the one to be averaged, realization by realization, and whose
// expectation is known.
struct Control {
  Eigen::ArrayXd sample;
  double expectation = 0;
};

// The mean of a sample. With a control: the control's expectation plus the mean difference of the sample from it.
Estimate Mean(const Eigen::ArrayXd& sample, const std::optional<Control>& control = {});

// Twice the square root of a variance, from the squared deviations of the realizations from a mean that was estimated
// from the same realizations. The sample mean is closer to the sample than the true mean is; adding `mean_correction`
// to the mean square corrects this bias. The standard error comes from the scatter of the squares themselves, so it
// also holds for distributions that are not normal (vertical errors at nadir are closer to chi-squared). Zero for a
// constant sample.
//
// With a control of the squares, the variance is b times the control's expectation plus the mean of the squares less b
// times the control. b is fitted to the other half of the sample, so that the variance is unbiased. With fewer than 64
// realizations there are too few to fit it, and b = 0. The control is also ignored where the corrected variance is not
// positive, which can happen by chance where the variance is close to zero.
Estimate TwoSigmaOfSquares(const Eigen::ArrayXd& squares, double mean_correction,
                           const std::optional<Control>& control = {});

// Twice the standard deviation of a sample.
Estimate TwoSigma(const Eigen::ArrayXd& sample);

// Rounds estimates to the binary digits that are stored. Digits below the standard error are noise, which does not
// compress.

// The nearest number with at most `bits` significant binary digits; ties go to even. `bits` is from 1 to 24, so that a
// float holds the result. The relative error is at most 2^-bits.
double RoundToBits(double value, int bits);

inline constexpr int kValueBits = 13;         // of an estimate, at most: a relative error of 1.2e-4
inline constexpr int kStandardErrorBits = 4;  // a relative error of 6 %

// Rounds the standard error to kStandardErrorBits. Rounds the value to a multiple of the largest power of two that is
// at most a quarter of that error, or to kValueBits where those are coarser. The value changes by at most an eighth of
// the standard error (1 / (4 sqrt(12)) = 0.07 of it rms) or by 2^-kValueBits of itself, whichever is larger.
Estimate Rounded(const Estimate& estimate);

}  // namespace albtpu
