#include "budget/water/green_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

constexpr double kWidths = 8;  // standard deviations of the pulse beyond which it has no light

// The waveform of the surface; times in ns after the glint would arrive.
class SurfaceEcho {
 public:
  SurfaceEcho(double glint, double attenuation, const WaterReceiver& receiver)
      : glint_(std::isinf(glint) ? 1 : glint),
        water_(std::isinf(glint) ? 0 : 1),
        sigma_(receiver.pulse_length / (2 * std::sqrt(2 * std::numbers::ln2))),
        decay_(receiver.group_index / (kLightSpeed * attenuation)) {}

  double sigma() const { return sigma_; }
  double operator()(double t) const { return glint_ * Pulse(t) + water_ * Water(t); }

  // Its maximum lies before the pulse has ended: then the water's part decays.
  double Peak() const {
    double best = 0;
    for (double t = 0; t < kWidths * sigma_; t += sigma_ / 8)
      if ((*this)(t) > (*this)(best)) best = t;
    double low = best - sigma_ / 8, high = best + sigma_ / 8;
    while (high - low > 1e-9 * sigma_) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      if ((*this)(left) < (*this)(right))
        low = left;
      else
        high = right;
    }
    return (low + high) / 2;
  }

  // Where it passes `level` between `below` and `above`.
  double Crossing(double level, double below, double above) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = (below + above) / 2;
      ((*this)(middle) < level ? below : above) = middle;
    }
    return (below + above) / 2;
  }

 private:
  double Pulse(double t) const {
    const double x = t / sigma_;
    return std::exp(-x * x / 2) / (sigma_ * std::sqrt(2 * std::numbers::pi));
  }
  // The pulse convolved with exp(-t / decay).
  double Water(double t) const {
    const double ratio = sigma_ / decay_;
    if (t < -kWidths * sigma_) return 0;
    return std::exp(ratio * ratio / 2 - t / decay_) * std::erfc((ratio - t / sigma_) / std::numbers::sqrt2) / 2;
  }

  double glint_, water_;
  double sigma_, decay_;
};

double TimeOf(const SurfaceEcho& echo, EchoDetector detector) {
  const double peak = echo.Peak();
  if (detector == EchoDetector::kPeak) return peak;
  return echo.Crossing(echo(peak) / 2, -kWidths * echo.sigma(), peak) + echo.sigma() * std::sqrt(2 * std::numbers::ln2);
}

// Mean and variance of the delay of a survey, whose glints are exponential.
struct DelayMoments {
  double mean = 0, variance = 0;
};

// The delay over the logarithm of the glint, for one water.
class Delays {
 public:
  Delays(double attenuation, const WaterReceiver& receiver) : none_(GreenSurfaceDelay(0, attenuation, receiver)) {
    for (std::size_t i = 0; i < kNodes; ++i)
      delays_.push_back(GreenSurfaceDelay(receiver.pulse_length * std::exp(kFirst + kStep * static_cast<double>(i)),
                                          attenuation, receiver));
  }

  double none() const { return none_; }

  // The logarithm is of the mean glint in lengths of the pulse.
  DelayMoments Of(double log_mean) const {
    DelayMoments moments;
    double squares = 0;
    constexpr int kQuantiles = 128;
    for (int i = 0; i < kQuantiles; ++i) {
      const double delay = At(log_mean + std::log(-std::log1p(-(i + 0.5) / kQuantiles)));
      moments.mean += delay / kQuantiles;
      squares += delay * delay / kQuantiles;
    }
    moments.variance = std::max(0.0, squares - moments.mean * moments.mean);
    return moments;
  }

  // The variance from pulse to pulse where the mean delay is `mean`, from 0 to none().
  double VarianceAt(double mean) const {
    double low = kFirst, high = kFirst + kStep * kNodes;  // more glint: less delay
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      (Of(middle).mean > mean ? low : high) = middle;
    }
    return Of((low + high) / 2).variance;
  }

 private:
  static constexpr std::size_t kNodes = 97;
  static constexpr double kFirst = -9.2, kStep = 0.2;  // from 1e-4 to 2e4 lengths of the pulse

  double At(double log_glint) const {
    const double place = (log_glint - kFirst) / kStep;
    if (place <= 0) return none_;
    const auto left = static_cast<std::size_t>(place);
    if (left + 1 >= kNodes) return 0;
    return std::lerp(delays_[left], delays_[left + 1], place - static_cast<double>(left));
  }

  double none_;
  std::vector<double> delays_;
};

// The attenuation of light in the first decimetres over K = sqrt(a^2 + 6 B a b), which is that of light that was
// scattered many times. What is scattered forwards stays within the field of view: a + B b remain (quasi-single
// scattering: Gordon 1973, doi:10.1364/AO.12.002803).
double FirstOverK(const WaterOptics& optics) {
  const double albedo = optics.typical_albedo();
  const double back = albedo / (1 - albedo) * optics.median_fraction();
  return (1 + back) / std::sqrt(1 + 6 * back);
}

}  // namespace

double GreenSurfaceDelay(double glint, double attenuation, const WaterReceiver& receiver) {
  assert(receiver.detector != EchoDetector::kCentroid);
  return kLightSpeed / 2 * TimeOf(SurfaceEcho(glint, attenuation, receiver), receiver.detector);
}

GreenSurface GreenSurfaceOf(const WaterOptics& optics, const WaterReceiver& receiver) {
  // Gauss-Hermite in the logarithm of the attenuation.
  const double root = std::sqrt(3.0) * optics.attenuation_log_sigma;
  const std::array<std::array<double, 2>, 3> waters = {{{-root, 1.0 / 6}, {0, 2.0 / 3}, {root, 1.0 / 6}}};
  constexpr int kMeans = 16;
  double mean = 0, squares = 0, spread = 0;
  for (const auto& [shift, weight] : waters) {
    const Delays delays(optics.attenuation * FirstOverK(optics) * std::exp(shift), receiver);
    const double none = delays.none();
    mean += weight * none / 2;
    squares += weight * none * none / 3;  // of a mean that is uniform from 0 to that without a glint
    for (int i = 0; i < kMeans; ++i) spread += weight / kMeans * delays.VarianceAt(none * (i + 0.5) / kMeans);
  }
  return {.mean = mean, .unknown = std::sqrt(std::max(0.0, squares - mean * mean)), .spread = std::sqrt(spread)};
}

ShiftBySurface ShiftBySurfaceOf(double incidence, double index) {
  const double sine = std::sin(incidence) / index;
  return {std::sin(incidence) - sine / index, std::cos(incidence) - std::sqrt(1 - sine * sine) / index};
}

}  // namespace albtpu
