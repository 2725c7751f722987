#include "tests/flights/smooth_motion.h"

#include <cmath>
#include <numbers>

namespace albtpu::testing {

double RandomNumbers::Uniform(double low, double high) {
  state_ += 0x9E3779B97F4A7C15;
  std::uint64_t bits = state_;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
  bits ^= bits >> 31;
  return low + (high - low) * (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

double RandomNumbers::Normal() {  // Box and Muller (1958).
  const double radius = std::sqrt(-2 * std::log(Uniform(0, 1)));
  return radius * std::cos(Uniform(0, 2 * std::numbers::pi));
}

// The mean square of a sinusoid is half the square of its amplitude.
SmoothMotion::SmoothMotion(double mean, double sigma, double lowest, double highest, int terms, RandomNumbers& random)
    : mean_(mean) {
  const double amplitude = sigma * std::sqrt(2.0 / terms);
  for (int i = 0; i < terms; ++i) {
    const double frequency = random.Uniform(lowest, highest);
    sinusoids_.push_back({amplitude, frequency, random.Uniform(0, 2 * std::numbers::pi)});
  }
}

SmoothMotion SmoothMotion::Plus(const SmoothMotion& other) const {
  SmoothMotion sum = *this;
  sum.mean_ += other.mean_;
  sum.sinusoids_.insert(sum.sinusoids_.end(), other.sinusoids_.begin(), other.sinusoids_.end());
  return sum;
}

double SmoothMotion::At(double time) const {
  double value = mean_;
  for (const Sinusoid& s : sinusoids_) value += s.amplitude * std::sin(s.frequency * time + s.phase);
  return value;
}

double SmoothMotion::RateAt(double time) const {
  double rate = 0;
  for (const Sinusoid& s : sinusoids_) rate += s.amplitude * s.frequency * std::cos(s.frequency * time + s.phase);
  return rate;
}

}  // namespace albtpu::testing
