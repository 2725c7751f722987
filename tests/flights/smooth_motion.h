// Smooth random functions of time.
#pragma once

#include <cstdint>
#include <vector>

namespace albtpu::testing {

// Uniform random numbers that are the same on every machine: splitmix64 (Steele et al. 2014,
// doi:10.1145/2714064.2660195).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  double Uniform(double low, double high);
  double Normal();  // Mean 0, variance 1.

 private:
  std::uint64_t state_;
};

// mean + sum of amplitude sin(frequency t + phase), with the derivative.
class SmoothMotion {
 public:
  struct Sinusoid {
    double amplitude = 0, frequency = 0, phase = 0;  // any unit, rad/s, rad
  };

  // `terms` sinusoids with frequencies between the two [rad/s] and a standard deviation of `sigma` over long times.
  SmoothMotion(double mean, double sigma, double lowest, double highest, int terms, RandomNumbers& random);

  // The same and more sinusoids, such as turbulence on a slow drift.
  SmoothMotion Plus(const SmoothMotion& other) const;

  double At(double time) const;
  double RateAt(double time) const;  // per second

 private:
  double mean_ = 0;
  std::vector<Sinusoid> sinusoids_;
};

}  // namespace albtpu::testing
