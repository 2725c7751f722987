#include "generator/math/rounding.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

// The binary exponent of the last of `bits` significant digits.
int LastDigit(double value, int bits) { return std::ilogb(value) + 1 - bits; }

// Adding zero turns -0 into +0.
double RoundToMultiple(double value, int exponent) {
  return std::ldexp(std::nearbyint(std::ldexp(value, -exponent)), exponent) + 0.0;
}

}  // namespace

double RoundToBits(double value, int bits) {
  assert(bits >= 1 && bits <= 24 && std::isfinite(value));
  return value == 0 ? 0 : RoundToMultiple(value, LastDigit(value, bits));
}

Estimate Rounded(const Estimate& estimate) {
  assert(estimate.standard_error >= 0);
  const double value = estimate.value, error = RoundToBits(estimate.standard_error, kStandardErrorBits);
  if (value == 0 || error == 0) return {RoundToBits(value, kValueBits), error};
  const int quarter_of_error = std::ilogb(error) - 2;
  return {RoundToMultiple(value, std::max(LastDigit(value, kValueBits), quarter_of_error)), error};
}

}  // namespace albtpu
