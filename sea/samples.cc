#include "sea/samples.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// The probability that |t| is at most sqrt(degrees) tan(angle): Abramowitz and Stegun (1964), 26.7.3 and 26.7.4.
double Within(double angle, int degrees) {
  const double sine = std::sin(angle), cosine = std::cos(angle), squared = cosine * cosine;
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1, sum = 0;
  for (int k = odd ? 1 : 0; k < degrees - 1; k += 2) {
    sum += term;
    term *= squared * (k + 1) / (k + 2);
  }
  return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
}

}  // namespace

double StudentQuantile(int degrees, double tail) {
  assert(degrees >= 1 && tail > 0 && tail <= 0.5);
  degrees = std::min(degrees, 1000);
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (Within(middle, degrees) < 1 - 2 * tail ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(low);
}

// Abramowitz and Stegun (1964), 26.4.19: the incomplete gamma function, with a = degrees / 2 and x = value / 2. Its
// series, 6.5.29, below a + 1; beyond it the continued fraction, 6.5.31, by the algorithm of Lentz.
double ChiSquareBelow(double value, double degrees) {
  assert(value >= 0 && degrees > 0);
  const double a = degrees / 2, x = value / 2;
  if (x == 0) return 0;
  constexpr double kLeast = 1e-300, kPrecise = 1e-15;
  constexpr int kMostTerms = 100'000;  // Of the order of the root of a.
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < kMostTerms && term > kPrecise * sum; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return scale * sum;
  }
  double b = x + 1 - a, c = 1 / kLeast, d = 1 / b, fraction = d;
  for (int n = 1; n < kMostTerms; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = numerator * d + b;
    c = b + numerator / c;
    if (std::abs(d) < kLeast) d = kLeast;
    if (std::abs(c) < kLeast) c = kLeast;
    d = 1 / d;
    fraction *= d * c;
    if (std::abs(d * c - 1) < kPrecise) break;
  }
  return 1 - scale * fraction;
}

}  // namespace albtpu
