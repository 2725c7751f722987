// Samples of numbers: their median, intervals from few of them, and the hash by which a part of many is drawn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace albtpu {

// The middle one of `values`, which are at least one; of an even number the upper one of the two in the middle.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// For intervals from few numbers: the value that is exceeded with the probability `tail`, above 0 and at most 0.5, by
// Student's t with `degrees`, 1 or more, degrees of freedom: 2.776 of 4 and 0.025. Right to 1e-9 of its value; beyond
// 1000 degrees as with 1000, which is 0.3 % at most too large.
double StudentQuantile(int degrees, double tail);

// The probability that a number with the distribution of chi-square with `degrees` degrees of freedom, above 0 and not
// only whole ones, is at most `value`, from 0. Right to 1e-12.
double ChiSquareBelow(double value, double degrees);

// What a standard error of so many degrees of freedom is multiplied by: Student's 97.5 % quantile exceeds 1.96 by that
// factor within 6 % of 5 degrees, and 2 % of 10.
constexpr double WidthOfStudent(double degrees) { return 1 + 1.2 / degrees; }

// Whether an element is drawn is a function of its key alone, never of the order in which elements come: the keys with
// the lowest hashes stay. Every bit of a key changes half of the bits of its hash.
//
// The finalizer of SplitMix64: Steele, Lea and Flood (2014), doi:10.1145/2660193.2660195.
constexpr std::uint64_t MixBits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace albtpu
