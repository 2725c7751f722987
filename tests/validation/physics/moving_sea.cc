#include "tests/validation/physics/moving_sea.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "sea/sampled_spectrum.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectrum_moments.h"
#include "validation/laboratory/virtual_tank.h"

namespace albtpu {
namespace {

constexpr double kAllLong = 1.2, kAllPatch = 2.5;  // rad/m
constexpr double kNodeSpacing = 0.25;              // m, of the long waves

// The odd part of the spectrum over the even one.
double OddPart(const WaveMotion& motion, double psi) {
  if (motion.travel == WaveTravel::kBothWays) return 0;
  const double c = std::cos(psi - motion.towards);
  return 2 * c / (1 + c * c);
}

// A part of the waves, which travel.
class PartOfWaves final : public WaveSpectrum {
 public:
  PartOfWaves(std::shared_ptr<const WaveSpectrum> whole, std::function<double(double k)> share,
              const WaveMotion& motion)
      : whole_(std::move(whole)), share_(std::move(share)), motion_(motion) {}

  double operator()(double k) const override {
    const double share = share_(k);
    return share > 0 ? share * (*whole_)(k) : 0;
  }
  double Spreading(double k, double psi) const override {
    return (*this)(k) > 0 ? whole_->Spreading(k, psi) * (1 + OddPart(motion_, psi)) : 0;
  }
  bool spreading_varies_with_wavenumber() const override { return true; }
  double peak_wavenumber() const override { return whole_->peak_wavenumber(); }
  WavenumberRange energetic_range() const override { return whole_->energetic_range(); }
  std::string name() const override { return whole_->name(); }
  std::string reference() const override { return ""; }
  std::string departures() const override { return ""; }

 private:
  std::shared_ptr<const WaveSpectrum> whole_;
  std::function<double(double k)> share_;
  WaveMotion motion_;
};

// Cubic interpolation from nodes to points, both from the same first position.
Eigen::MatrixXd Interpolation(int points, double spacing, int nodes) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(points, nodes);
  for (int i = 0; i < points; ++i) {
    const double position = i * spacing / kNodeSpacing + 1;  // one node before the first point
    const int whole = static_cast<int>(position);
    const double t = position - whole;
    weights(i, whole - 1) = -t * (t - 1) * (t - 2) / 6;
    weights(i, whole) = (t + 1) * (t - 1) * (t - 2) / 2;
    weights(i, whole + 1) = -(t + 1) * t * (t - 2) / 2;
    weights(i, whole + 2) = (t + 1) * t * (t - 1) / 6;
  }
  return weights;
}

}  // namespace

struct MovingSea::Parts {
  SeaState patch, whole;
  LongWaveModel waves;
  Eigen::VectorXd frequency, forward;  // of each long wave: rad/s, and the share that travels towards its wavenumber
  Eigen::MatrixXcd phases_x, phases_y;
  Eigen::MatrixXd refine;

  Parts(std::shared_ptr<const WaveSpectrum> spectrum, const WaveMotion& motion)
      : patch({.waves = KnownWaves{std::make_shared<PartOfWaves>(spectrum, CrossFade(kAllLong, kAllPatch), motion)}}),
        whole({.waves = KnownWaves{spectrum}}),
        waves(whole, CrossFade(kAllLong, kAllPatch)) {
    const auto count = static_cast<Eigen::Index>(waves.waves().size());
    frequency.resize(count);
    forward.resize(count);
    const double spacing = kLength / kPoints;
    const int nodes = static_cast<int>(kLength / kNodeSpacing) + 4;
    phases_x.resize(nodes, count);
    phases_y.resize(nodes, count);
    for (Eigen::Index m = 0; m < count; ++m) {
      const Eigen::Vector2d k = waves.waves()[m].wavenumber;
      frequency[m] = AngularFrequency(k.norm(), motion.water_depth);
      forward[m] = (1 + OddPart(motion, std::atan2(k.y(), k.x()))) / 2;
      for (int i = 0; i < nodes; ++i) {
        const double at = -kLength / 2 + (i - 1) * kNodeSpacing;
        phases_x(i, m) = std::polar(1.0, k.x() * at);
        phases_y(i, m) = std::polar(1.0, k.y() * at);
      }
    }
    refine = Interpolation(kPoints + 1, spacing, nodes);
  }
};

MovingSea::MovingSea(const HarmonicSpectrum& spectrum, const WaveMotion& motion)
    : parts_(std::make_unique<const Parts>(std::make_shared<SampledSpectrum>(spectrum, SpectrumText{}), motion)) {}

MovingSea::~MovingSea() = default;

std::vector<HeightField> MovingSea::Draw(const NormalStream& stream, const std::vector<double>& times) const {
  const EvolvingPatch patch(parts_->patch, kLength, kPoints, stream);
  NormalStream there = stream.Part(10001), back = stream.Part(10002);
  const Eigen::VectorXcd towards = parts_->waves.Draw(there), against = parts_->waves.Draw(back);
  std::vector<HeightField> surfaces;
  for (const double time : times) {
    Eigen::VectorXcd amplitudes(towards.size());
    for (Eigen::Index m = 0; m < amplitudes.size(); ++m) {
      const std::complex<double> turn = std::polar(1.0, -parts_->frequency[m] * time);
      amplitudes[m] = std::sqrt(parts_->forward[m]) * towards[m] * turn +
                      std::sqrt(1 - parts_->forward[m]) * against[m] * std::conj(turn);
    }
    const Eigen::MatrixXd nodes = SumOfWaves(parts_->phases_x, amplitudes, parts_->phases_y);
    const Eigen::MatrixXd long_waves = parts_->refine * nodes * parts_->refine.transpose();
    const std::vector<double> short_waves = patch.HeightsAt(time);
    constexpr int kSide = kPoints + 1;
    std::vector<double> heights(static_cast<std::size_t>(kSide) * kSide);
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        heights[static_cast<std::size_t>(i) * kSide + j] =
            long_waves(i, j) + short_waves[static_cast<std::size_t>(i % kPoints) * kPoints + j % kPoints];
      }
    }
    surfaces.emplace_back(std::move(heights), kSide, kLength / kPoints);
  }
  return surfaces;
}

HarmonicSpectrum WithoutShortWaves(HarmonicSpectrum spectrum) {
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double t = std::clamp(std::log(MovingSea::kShortest / spectrum.k[i]) / std::log(1.5), 0.0, 1.0);
    spectrum.s[i] *= 0.5 - 0.5 * std::cos(std::numbers::pi * t);
  }
  return spectrum;
}

PulseTracer::PulseTracer(const BeamOptions& beam, double refractive_index, int rays)
    : rays_(Beam(beam, rays).Rays(0)),
      refractive_index_(refractive_index),
      along_(std::cos(beam.azimuth), std::sin(beam.azimuth)),
      refracted_(StillWaterRefraction(beam.incidence, refractive_index)) {}

TracedPulse PulseTracer::operator()(const HeightField& surface, const Eigen::Vector2d& at) const {
  Eigen::Vector2d tangent = Eigen::Vector2d::Zero();
  double secant = 0, height = 0;
  for (Ray ray : rays_) {
    ray.at_zero += at;
    const Hit hit = Intersect(surface, ray);
    const RefractedRay refracted = RefractAtSlope(ray.direction, hit.facet.slope, refractive_index_);
    tangent += refracted.tangent;
    secant += refracted.secant;
    height += hit.height;
  }
  const auto count = static_cast<double>(rays_.size());
  TracedPulse pulse;
  pulse << secant / count * std::sin(refracted_) * along_ - tangent / count, 1 - secant / count * std::cos(refracted_),
      height / count;
  return pulse;
}

}  // namespace albtpu
