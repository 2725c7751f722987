#include "tests/validation/physics/green_surface_walk.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tables/water/water_schema.h"
#include "validation/studies/water_round_trip.h"

namespace albtpu {
namespace {

using Eigen::Vector3d;

// Light that is scattered by more than the first of these angles is followed apart, by `children` photons a band that
// share its weight: few photons come back by chance.
struct Band {
  double from;  // degree
  int children;
};
constexpr std::array kBands = {Band{45, 1}, Band{100, 2}, Band{150, 8}};

// A last scattering by more than this angle into the cone counts with its probability, one by less where it happens:
// there the phase function has its peak.
constexpr double kLastAngle = 20 * M_PI / 180;

struct Photon {
  Vector3d at = Vector3d::Zero(), going = Vector3d::UnitZ();  // z is down
  double path = 0, weight = 1;
  int scatterings = 0;
  bool little = false;  // The last of them was by less than kLastAngle.

  void Go(double way) {
    at += way * going;
    path += way;
  }
};

// 1/sr, of a photon that is scattered by an angle whose cosine is given, from kLastAngle to 180 degrees.
class Density {
 public:
  explicit Density(const PhaseFunction& phase) {
    constexpr double kHalf = 0.5 * M_PI / 180;
    for (int i = 0; i <= kSteps; ++i) {
      const double psi = std::acos(CosineOf(i)), low = psi - kHalf, high = std::min(M_PI, psi + kHalf);
      values_[static_cast<std::size_t>(i)] =
          (phase.ShareBelow(high) - phase.ShareBelow(low)) / (2 * M_PI * (std::cos(low) - std::cos(high)));
    }
  }
  double operator()(double cosine) const {
    const double place = std::clamp((1 - cosine) / 2 * kSteps, 0.0, kSteps - 1e-9);
    const auto left = static_cast<std::size_t>(place);
    return std::lerp(values_[left], values_[left + 1], place - static_cast<double>(left));
  }

 private:
  static constexpr int kSteps = 1000;
  static double CosineOf(int i) { return std::min(1 - 2.0 * i / kSteps, std::cos(kLastAngle / 2)); }

  std::array<double, kSteps + 1> values_{};
};

class Walker {
 public:
  Walker(const PhaseFunction& phase, const GreenSurfaceWalk& walk, std::mt19937_64& random, WalkedEcho& echo)
      : phase_(phase), density_(phase), walk_(walk), random_(random), echo_(echo) {
    const double sine = std::sin(walk.incidence) / walk.refractive_index;
    down_ = {sine, 0, std::sqrt(1 - sine * sine)};
    critical_ = std::sqrt(1 - 1 / (walk.refractive_index * walk.refractive_index));
    longest_ = kLightSpeed * walk.longest / walk.group_index;
    solid_angle_ = 2 * M_PI * (1 - std::cos(walk.cone));
    for (std::size_t i = 0; i <= kBands.size(); ++i)
      shares_[i] = i < kBands.size() ? phase.ShareBelow(kBands[i].from * M_PI / 180) : 1;
    // A beam that nothing dims has this much light in the cone for each ns of delay.
    const double back = walk.scattering * (1 - phase.ShareBelow(M_PI - walk.cone));
    unit_ = back * kLightSpeed / (2 * walk.group_index) * WalkedEcho::kStep * walk.photons;
  }

  // The fraction `before` of all photons is scattered for the first time before this one.
  void Launch(double before) {
    // That is within the longest path, with the probability that this has.
    const double within = -std::expm1(-walk_.scattering * longest_);
    Photon photon{.going = down_, .weight = within};
    photon.Go(-std::log1p(-within * before) / walk_.scattering);
    do {
      ReceiveFrom(photon);
      for (std::size_t band = 0; band < kBands.size(); ++band) {
        const double share = shares_[band + 1] - shares_[band];
        for (int i = 0; i < kBands[band].children; ++i) {
          Photon child = photon;
          child.weight *= share / kBands[band].children;
          Scatter(child, shares_[band] + share * Uniform(random_));
          while (Fly(child)) {
            ReceiveFrom(child);
            Scatter(child, Uniform(random_));
          }
        }
      }
      photon.weight *= shares_[0];
      Scatter(photon, shares_[0] * Uniform(random_));
    } while (Fly(photon));
  }

 private:
  // To its next scattering. False: it has left the water, or is too late to matter.
  bool Fly(Photon& photon) {
    double free = -std::log(Uniform(random_)) / walk_.scattering;
    while (photon.at.z() + free * photon.going.z() < 0) {
      const double way = -photon.at.z() / photon.going.z();
      photon.Go(way);
      photon.at.z() = 0;
      if (-photon.going.z() > critical_) {
        if (photon.little && -photon.going.dot(down_) > std::cos(walk_.cone)) Receive(photon);
        return false;
      }
      free -= way;
      photon.going.z() = -photon.going.z();
    }
    photon.Go(free);
    return photon.path < longest_;
  }
  void Scatter(Photon& photon, double share) {
    const double sin_half = phase_.SinHalf(share);
    photon.going = Turned(photon.going, sin_half, random_);
    photon.little = sin_half < std::sin(kLastAngle / 2);
    ++photon.scatterings;
  }

  // What is scattered here into the cone, and leaves the water without being scattered again.
  void ReceiveFrom(Photon photon) {
    const Vector3d to = Turned(-down_, std::sin(walk_.cone / 2) * std::sqrt(Uniform(random_)), random_);
    const double cosine = photon.going.dot(to);
    if (cosine > std::cos(kLastAngle)) return;
    const double way = photon.at.z() / -to.z();
    photon.weight *= density_(cosine) * solid_angle_ * std::exp(-walk_.scattering * way);
    photon.going = to;
    photon.Go(way);
    ++photon.scatterings;
    Receive(photon);
  }

  // At the surface, within the cone.
  void Receive(const Photon& photon) {
    const double delay = (walk_.group_index * photon.path + std::sin(walk_.incidence) * photon.at.x()) / kLightSpeed;
    const double place = delay / WalkedEcho::kStep;
    if (place < 0 || place >= static_cast<double>(echo_.once.size())) return;
    const auto step = static_cast<std::size_t>(place);
    const double weight = photon.weight * std::exp(-walk_.absorption * photon.path) / unit_;
    const double diameter = 2 * std::hypot(photon.at.x() * std::cos(walk_.incidence), photon.at.y());
    for (std::size_t i = 0; i < walk_.fields_of_view.size(); ++i)
      if (diameter <= walk_.fields_of_view[i]) echo_.seen[i][step] += weight;
    if (photon.scatterings == 1) echo_.once[step] += weight;
  }

  const PhaseFunction& phase_;
  const Density density_;
  const GreenSurfaceWalk& walk_;
  std::mt19937_64& random_;
  WalkedEcho& echo_;
  Vector3d down_;
  double critical_, longest_, solid_angle_, unit_;
  std::array<double, kBands.size() + 1> shares_{};
};

}  // namespace

std::vector<WalkedEcho> WalkGreenSurface(const PhaseFunction& phase, const GreenSurfaceWalk& walk, std::uint64_t seed) {
  const std::vector<double> none(static_cast<std::size_t>(walk.longest / WalkedEcho::kStep));
  std::vector<WalkedEcho> pools(walk.pools, {.seen = {walk.fields_of_view.size(), none}, .once = none});
  tbb::parallel_for(std::uint32_t{0}, walk.pools, [&](std::uint32_t pool) {
    std::mt19937_64 random(seed * 1000 + pool);
    Walker walker(phase, walk, random, pools[pool]);
    for (std::uint32_t i = 0; i < walk.photons; ++i) walker.Launch((i + Uniform(random)) / walk.photons);
  });
  return pools;
}

double DelayOfWaveform(const std::vector<double>& light, double glint, const WaterReceiver& receiver) {
  constexpr double kStep = WalkedEcho::kStep;
  const double sigma = receiver.pulse_length / (2 * std::sqrt(2 * std::numbers::ln2)), scale = 1 / (sigma * M_SQRT2);
  const auto last = static_cast<int>(5.5 * sigma / kStep);
  // The pulse, and the mean over each step of light.
  std::vector<double> pulse, of_step;
  for (int i = -last; i <= last; ++i) {
    const double t = i * kStep;
    pulse.push_back(std::exp(-std::pow(t * scale, 2)) * scale / std::sqrt(std::numbers::pi));
    of_step.push_back((std::erf(t * scale) - std::erf((t - kStep) * scale)) / 2);
  }
  std::vector<double> waveform;  // From -last steps on.
  for (int i = -last; i < 2 * last; ++i) {
    double sum = i <= last ? glint * pulse[static_cast<std::size_t>(i + last)] : 0;
    const int first = std::max(0, i - last), end = std::min(static_cast<int>(light.size()), i + last + 1);
    for (int j = first; j < end; ++j)
      sum += light[static_cast<std::size_t>(j)] * of_step[static_cast<std::size_t>(i - j + last)];
    waveform.push_back(sum);
  }
  const auto peak = std::max_element(waveform.begin(), waveform.end());
  double place = static_cast<double>(peak - waveform.begin());
  if (receiver.detector == EchoDetector::kPeak) {
    // Through the three highest.
    place += (*(peak - 1) - *(peak + 1)) / (*(peak - 1) - 2 * *peak + *(peak + 1)) / 2;
  } else {
    const auto over = std::find_if(waveform.begin(), waveform.end(), [&](double w) { return w >= *peak / 2; });
    place = static_cast<double>(over - waveform.begin()) - (*over - *peak / 2) / (*over - *(over - 1));
  }
  const double time = (place - last) * kStep;
  return kLightSpeed / 2 * (receiver.detector == EchoDetector::kPeak ? time : time + receiver.pulse_length / 2);
}

WalkedDelay DelayOf(const std::vector<WalkedEcho>& pools,
                    const std::function<const std::vector<double>&(const WalkedEcho&)>& light, double glint,
                    const WaterReceiver& receiver) {
  const auto count = static_cast<double>(pools.size());
  std::vector<double> sum(light(pools.front()).size()), without(sum.size());
  for (const WalkedEcho& pool : pools)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light(pool)[i] / count;
  double mean = 0, squares = 0;
  for (const WalkedEcho& pool : pools) {
    for (std::size_t i = 0; i < sum.size(); ++i) without[i] = (sum[i] * count - light(pool)[i]) / (count - 1);
    const double delay = DelayOfWaveform(without, glint, receiver);
    mean += delay / count, squares += delay * delay / count;
  }
  return {DelayOfWaveform(sum, glint, receiver), std::sqrt(std::max(0.0, squares - mean * mean) * (count - 1))};
}

}  // namespace albtpu
