#include "budget/water/water_draws.h"

#include <algorithm>
#include <cmath>

namespace albtpu {
namespace {

// The inverse of the standard normal distribution, by Newton's steps.
double NormalQuantile(double p) {
  if (p < 0.5) return -NormalQuantile(1 - p);
  double x = std::sqrt(-2 * std::log(2 * (1 - p)) + 1e-300) * 0.8;
  for (int i = 0; i < 60; ++i) {
    const double below = 0.5 * std::erfc(-x / std::sqrt(2.0));
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::acos(-1.0));
    x -= std::clamp((below - p) / density, -0.5, 0.5);
  }
  return x;
}

// Number i of van der Corput's sequence.
double Radical(std::size_t i, std::size_t base) {
  double value = 0, digit = 1.0 / static_cast<double>(base);
  for (; i > 0; i /= base, digit /= static_cast<double>(base)) value += digit * static_cast<double>(i % base);
  return value;
}

// How many waters scatter at most `ratio` times as much as they absorb, without the limits of that.
double Below(const WaterOptics& optics, double ratio) {
  if (!(ratio > 0)) return 0;
  if (!(optics.ratio_log_sigma > 0)) return ratio < optics.scattering_over_absorption ? 0 : 1;
  const double x = std::log(ratio / optics.scattering_over_absorption) / optics.ratio_log_sigma;
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

}  // namespace

double ShareBeyond(const WaterOptics& optics, double ratio) {
  const double least = Below(optics, optics.min_ratio), most = Below(optics, optics.max_ratio);
  return most > least ? std::clamp((most - Below(optics, ratio)) / (most - least), 0.0, 1.0) : 0;
}

std::vector<DrawnWater> DrawWaters(const WaterOptics& optics, std::size_t count) {
  std::vector<DrawnWater> draws;
  // The limits of b / a as probabilities of its distribution.
  const double least = Below(optics, optics.min_ratio), most = Below(optics, optics.max_ratio);
  for (std::size_t i = 0; i < count; ++i) {
    const double even = least + (most - least) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    DrawnWater draw{};
    draw.fraction = optics.least_fraction * std::pow(optics.most_fraction / optics.least_fraction, Radical(i + 1, 3));
    draw.attenuation =
        std::max(1.001 * kPureWaterAbsorption,
                 optics.attenuation * std::exp(optics.attenuation_log_sigma * NormalQuantile(Radical(i + 1, 2))));
    draw.ratio = optics.scattering_over_absorption * std::exp(optics.ratio_log_sigma * NormalQuantile(even));
    draw.ratio = std::min(draw.ratio, WaterOptics::MaxRatio(draw.attenuation, draw.fraction));
    draws.push_back(draw);
  }
  return draws;
}

}  // namespace albtpu
