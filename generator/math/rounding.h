// Rounds estimates to the binary digits that are stored. Digits below the standard error are noise, which does not
// compress.
#pragma once

#include "generator/math/statistics.h"

namespace albtpu {

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
