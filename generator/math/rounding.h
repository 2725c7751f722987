// The binary digits of a number that are worth storing: those below its standard error are noise, which no
// file compresses.
#pragma once

#include "generator/math/statistics.h"

namespace albtpu {

// The nearest number of at most `bits` significant binary digits, halves to even; `bits` from 1 to 24, so that
// a float holds it. Its relative error is at most 2^-bits.
double RoundToBits(double value, int bits);

inline constexpr int kValueBits = 13;         // of an estimate, at most: 1.2e-4 of it
inline constexpr int kStandardErrorBits = 4;  // 6 % of it

// The standard error to kStandardErrorBits; the value to the nearest multiple of a power of two, the largest
// that is not above a quarter of that, and to kValueBits if they are coarser: off by an eighth of the standard
// error (0.07 rms) or by 2^-kValueBits of the value, whichever is more.
Estimate Rounded(const Estimate& estimate);

}  // namespace albtpu
