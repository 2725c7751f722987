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

}  // namespace albtpu
