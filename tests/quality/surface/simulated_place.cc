#include "tests/quality/surface/simulated_place.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sea/angle.h"
#include "sea/correlation/moving_waves.h"
#include "sea/response/closed_form.h"
#include "sea/samples.h"
#include "sea/sea_state.h"

namespace albtpu::quality {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFootprint = 0.6, kIndex = 1.34;
constexpr double kShortest = 30;  // rad/m: the footprint hides what is shorter, of the waves that are drawn and stated.
constexpr double kFlightHeight = 400, kFlightSpeed = 50;  // m, m/s
constexpr double kDepth = 8;                              // m, in the middle
const Vector2d kSlope(0.15, -0.1);
const Vector2d kMiddle = Vector2d::Constant(SimulatedPlace::kWest + SimulatedPlace::kWidth / 2);
const Vector3d kPulseSigma(0.04, 0.04, 0.03), kLineSigma(0.03, 0.03, 0.03), kSurveySigma(0.03, 0.02, 0.015);

HarmonicSpectrum Sea() {
  const WindSea waves{.wind_speed_10m = 6, .fetch = 20'000, .model = &kElfouhailyModel};
  HarmonicSpectrum sea = Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
  for (std::size_t i = 0; i < sea.size(); ++i)
    if (sea.k[i] > kShortest) sea.s[i] = 0;
  return sea;
}

// One realization: two normal amplitudes for each step of wavenumber and direction, somewhere in it.
class TravellingWaves {
 public:
  TravellingWaves(const HarmonicSpectrum& sea, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> within(0, 1);
    constexpr int kDirections = 24;
    for (std::size_t i = 1; i + 2 < sea.size(); i += 2) {
      if (!(sea.s[i + 1] > 0) || sea.k[i] < 0.05) continue;
      // Two samples.
      const double from = std::sqrt(sea.k[i - 1] * sea.k[i]), to = std::sqrt(sea.k[i + 1] * sea.k[i + 2]);
      const double energy = std::sqrt(sea.s[i] * sea.s[i + 1]) * (to - from);
      for (int j = 0; j < kDirections; ++j) {
        const double k = from * std::pow(to / from, within(random));
        const double psi = 2 * std::numbers::pi * (j + within(random)) / kDirections, c = std::cos(psi);
        double spread = 1;
        for (std::size_t n = 0; n < sea.harmonics(); ++n)
          spread += 2 * (sea.a[n][i] * std::cos(2 * (n + 1.0) * psi) + sea.b[n][i] * std::sin(2 * (n + 1.0) * psi));
        // They travel downwind, as WaveTravel::kOneWay says.
        spread *= 1 + 2 * c / (1 + c * c);
        const double variance = energy / kDirections * std::max(spread, 0.0);
        waves_.push_back({.k = {k * c, k * std::sin(psi)},
                          .omega = std::sqrt(9.81 * k * (1 + std::pow(k / 370, 2))),
                          .cosine = std::sqrt(variance) * normal(random),
                          .sine = std::sqrt(variance) * normal(random)});
      }
    }
  }

  // Of the slope under the footprint of `beam`.
  void Weight(const BeamOptions& beam) {
    const auto n = static_cast<Eigen::Index>(waves_.size());
    for (Eigen::ArrayXf* const column : {&kx_, &ky_, &omega_, &cosine_, &sine_}) column->resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Wave& wave = waves_[static_cast<std::size_t>(i)];
      const double weight = FootprintAverage(beam, wave.k.norm(), std::atan2(wave.k.y(), wave.k.x()));
      kx_(i) = static_cast<float>(wave.k.x()), ky_(i) = static_cast<float>(wave.k.y());
      omega_(i) = static_cast<float>(wave.omega);
      cosine_(i) = static_cast<float>(weight * wave.cosine), sine_(i) = static_cast<float>(weight * wave.sine);
    }
  }
  Vector2d SlopeAt(const Vector2d& at, double time) const {
    const auto x = static_cast<float>(at.x()), y = static_cast<float>(at.y()), t = static_cast<float>(time);
    const Eigen::ArrayXf phase = kx_ * x + ky_ * y - omega_ * t;
    const Eigen::ArrayXf of_height = sine_ * phase.cos() - cosine_ * phase.sin();
    return {(kx_ * of_height).sum(), (ky_ * of_height).sum()};
  }

 private:
  struct Wave {
    Vector2d k;
    double omega, cosine, sine;
  };
  std::vector<Wave> waves_;
  Eigen::ArrayXf kx_, ky_, omega_, cosine_, sine_;
};

Vector3d Draw(const Vector3d& sigma, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {sigma.x() * normal(random), sigma.y() * normal(random), sigma.z() * normal(random)};
}

// Where a beam meets the mean surface, when, and its direction on the way down, counted to the left of east.
struct Pulse {
  Vector2d at;
  double time, azimuth, incidence;

  Vector2d along() const { return {std::cos(azimuth), std::sin(azimuth)}; }
  double still() const { return StillWaterRefraction(incidence, kIndex); }
  RefractedRay Refracted(const Vector2d& slope) const {
    const double sine = std::sin(incidence);
    return RefractAtSlope({sine * along().x(), sine * along().y(), -std::cos(incidence)}, slope, kIndex);
  }
  // Where it meets the bottom below calm water, nearly.
  Vector2d OnBottom() const { return at - SimulatedPlace::HeightAt(at) * std::tan(still()) * along(); }
  // Of the reported height over a level bottom, per depth: the mean over normal slopes, by Gauss and Hermite.
  double Bias(const Eigen::Matrix2d& root_of_slopes) const {
    constexpr std::array<std::pair<double, double>, 3> kNodes = {
        {{-std::numbers::sqrt3, 1.0 / 6}, {0, 2.0 / 3}, {std::numbers::sqrt3, 1.0 / 6}}};
    double mean = 0;
    for (const auto& [u, of_u] : kNodes)
      for (const auto& [v, of_v] : kNodes)
        mean += of_u * of_v * (1 - Refracted(root_of_slopes * Vector2d(u, v)).secant * std::cos(still()));
    return mean;
  }
};
// Pulses that one footprint stands for: the fore or the aft part of a line.
using Look = std::vector<Pulse>;

// The pulses of one line over the place.
class Scan {
 public:
  Scan(const SimulatedLine& line, double spacing, std::mt19937_64& random) : line_(line), spacing_(spacing) {
    const double heading = RadiansOfDegrees(90 - line.heading);
    ahead_ = {std::cos(heading), std::sin(heading)};
    right_ = {ahead_.y(), -ahead_.x()};
    std::uniform_real_distribution<double> within(0, 1);
    // Lines and pulses of a scan begin anywhere.
    const double first = within(random), phase = within(random);
    if (line.pattern == ScanPattern::kRandom) {
      AddRandom(random);
    } else if (line.pattern == ScanPattern::kRaster) {
      AddRaster(first, phase);
    } else {
      AddPalmer(1, first, phase);
      AddPalmer(-1, first, phase);
    }
  }
  const std::vector<Look>& looks() const { return looks_; }

 private:
  static constexpr double kReach = SimulatedPlace::kWidth * 0.75;  // m: from the middle of the place beyond its corners

  // The aircraft is `along` m after the middle of the place; the beam meets the surface `offset` from below it.
  void Add(double along, double ahead, double aside, Look& look) {
    const Vector2d offset = ahead * ahead_ + aside * right_;
    const Vector2d at = kMiddle + (along * ahead_ - line_.aside * right_) + offset;
    const Vector2d inside = (at - kMiddle).cwiseAbs();
    if (inside.maxCoeff() > SimulatedPlace::kWidth / 2) return;
    look.push_back({.at = at,
                    .time = line_.start + along / kFlightSpeed,
                    .azimuth = std::atan2(offset.y(), offset.x()),
                    .incidence = std::atan2(offset.norm(), kFlightHeight)});
  }

  // Turns lie `spacing_` apart along the line, pulses about as far apart on a turn. `side` is 1 for the fore part.
  void AddPalmer(int side, double first, double phase) {
    const double long_side = kFlightHeight * std::tan(RadiansOfDegrees(14)),
                 wide_side = kFlightHeight * std::tan(RadiansOfDegrees(20));
    const double middle = std::asin(line_.aside / wide_side);
    const double turn = side > 0 ? middle : std::numbers::pi - middle;
    const double step = spacing_ / std::hypot(long_side * std::sin(turn), wide_side * std::cos(turn));
    Look look;
    const auto turns = static_cast<int>(std::ceil(2 * kReach / spacing_)),
               pulses = static_cast<int>(kReach * 1.2 / spacing_);
    for (int j = -turns; j <= turns; ++j) {
      for (int i = -pulses; i <= pulses; ++i) {
        // The pulses of following turns are not aligned.
        const double angle = turn + (i + phase + 0.382 * j) * step - step * std::floor(phase + 0.382 * j);
        const double along = -long_side * std::cos(turn) + spacing_ * (j + first + angle / (2 * std::numbers::pi));
        Add(along, long_side * std::cos(angle), wide_side * std::sin(angle), look);
      }
    }
    looks_.push_back(std::move(look));
  }

  // Each sweep to the other side takes the time in which the aircraft flies `spacing_`.
  void AddRaster(double first, double phase) {
    const double middle = std::atan(line_.aside / kFlightHeight), most = RadiansOfDegrees(20);
    const double step = spacing_ / kFlightHeight * std::pow(std::cos(middle), 2);
    Look look;
    const auto sweeps = static_cast<int>(std::ceil(kReach / spacing_)) + 1;
    for (int j = -sweeps; j <= sweeps; ++j)
      for (int i = -sweeps; i <= sweeps; ++i) {
        const double shift = phase + 0.382 * j;
        const double angle = middle + (i + shift - std::floor(shift)) * step;
        const double of_sweep = (angle + most) / (2 * most);
        const double along = spacing_ * (j + first + (j % 2 == 0 ? of_sweep : 1 - of_sweep));
        Add(along, 0, kFlightHeight * std::tan(angle), look);
      }
    looks_.push_back(std::move(look));
  }

  void AddRandom(std::mt19937_64& random) {
    constexpr double kWidth = SimulatedPlace::kWidth;
    std::uniform_real_distribution<double> within(-kWidth / 2, kWidth / 2);
    std::poisson_distribution<int> count(std::pow(kWidth / spacing_, 2));
    Look look;
    for (int i = count(random); i > 0; --i) {
      const Vector2d at(within(random), within(random));
      look.push_back({.at = kMiddle + at,
                      .time = line_.start + at.dot(ahead_) / kFlightSpeed,
                      .azimuth = std::atan2(ahead_.y(), ahead_.x()),
                      .incidence = RadiansOfDegrees(20)});
    }
    looks_.push_back(std::move(look));
  }

  const SimulatedLine& line_;
  double spacing_;
  Vector2d ahead_, right_;
  std::vector<Look> looks_;
};

}  // namespace

SimulatedPlace::SimulatedPlace(std::vector<SimulatedLine> lines, double spacing, const std::vector<double>& cells,
                               double shared)
    : lines_(std::move(lines)),
      spacing_(spacing),
      shared_(shared),
      sea_(Sea()),
      slopes_(MovingWaves(sea_).Under({.footprint = kFootprint}).Whole().slopes) {
  for (const double cell : cells) {
    sharing_.emplace_back(cell, std::make_unique<SeaSharing>(cell));
    sharing_.back().second->Add({.spectrum = sea_, .x_azimuth = std::numbers::pi / 2, .water_index = kIndex});
  }
}

const SeaSharing& SimulatedPlace::SharingAt(double cell) const {
  return *std::ranges::find(sharing_, cell, [](const auto& each) { return each.first; })->second;
}

double SimulatedPlace::HeightAt(const Vector2d& at) { return -kDepth + kSlope.dot(at - kMiddle); }

Vector3d SimulatedPlace::Upward() { return {-kSlope.x(), -kSlope.y(), 1}; }

WavesOfTwoPasses SimulatedPlace::OfTwoPasses() const { return {sea_, kFootprint, kIndex, Upward()}; }

NodeSources SimulatedPlace::SourcesFor(double cell) const {
  const Vector3d of_pulse = kPulseSigma.cwiseAbs2(), of_line = (shared_ * kLineSigma).cwiseAbs2(),
                 of_survey = (shared_ * kSurveySigma).cwiseAbs2();
  const double all = (of_pulse + of_line + of_survey).head<2>().sum();
  const HorizontalGroups groups = {.pulse = of_pulse.head<2>().sum() / all,
                                   .line = of_line.head<2>().sum() / all,
                                   .survey = of_survey.head<2>().sum() / all};
  const SeaSharing& sharing = SharingAt(cell);
  return {.sea = [&sharing](auto... pass) { return sharing(pass...); }, .groups = [groups](auto) { return groups; }};
}

void SharedErrors::AddTo(std::vector<SurfacePoint>& points) const {
  for (SurfacePoint& point : points) {
    const Vector3d error = survey + lines.at(point.flight_line);
    point.x += error.x(), point.y += error.y(), point.z += error.z();
  }
}

SharedErrors SimulatedPlace::DrawShared(std::uint64_t seed) const {
  std::mt19937_64 random(MixBits(seed));
  SharedErrors drawn{.survey = Draw(shared_ * kSurveySigma, random), .lines = {}};
  for (const SimulatedLine& line : lines_) drawn.lines[line.number] = Draw(shared_ * kLineSigma, random);
  return drawn;
}

DrawnSurvey SimulatedPlace::Survey(std::uint64_t seed, std::span<const Vector2d> around) const {
  std::mt19937_64 random(seed);
  TravellingWaves waves(sea_, random);
  const Eigen::Matrix2d root_of_slopes = slopes_.llt().matrixL();
  const auto is_drawn = [&](const Pulse& pulse) {
    return around.empty() || std::ranges::any_of(around, [on_bottom = pulse.OnBottom()](const Vector2d& each) {
             return (each - on_bottom).norm() < kReach;
           });
  };
  const Vector3d line_sigma = shared_ * kLineSigma, survey_sigma = shared_ * kSurveySigma;
  const Eigen::Matrix3d others =
      (kPulseSigma.cwiseAbs2() + line_sigma.cwiseAbs2() + survey_sigma.cwiseAbs2()).asDiagonal();
  DrawnSurvey survey;
  for (const SimulatedLine& line : lines_) {
    const Scan scan(line, spacing_, random);
    for (const Look& look : scan.looks()) {
      if (look.empty()) continue;
      const Pulse& typical = look[look.size() / 2];
      waves.Weight({.incidence = typical.incidence, .azimuth = typical.azimuth, .footprint = kFootprint});
      for (const Pulse& pulse : look) {
        if (!is_drawn(pulse)) continue;
        const double still = pulse.still();
        const RefractedRay ray = pulse.Refracted(waves.SlopeAt(pulse.at, pulse.time));
        // The true ray meets the bottom; its path is laid along that of still water.
        const double path = -HeightAt(pulse.at) / (1 + kSlope.dot(ray.tangent)) * ray.secant;
        const double depth = path * std::cos(still);
        Vector3d at;
        at << pulse.at + path * std::sin(still) * pulse.along(), -depth;
        const double by_waves = (at.z() - HeightAt(at.head<2>())) / depth;
        const Vector3d reported = at + Draw(kPulseSigma, random);

        const double azimuth = 90 - DegreesOfRadians(pulse.azimuth), incidence = DegreesOfRadians(pulse.incidence);
        // What waves do to one pulse, per depth^2.
        const Eigen::Matrix3d of_waves =
            sharing_.front().second->operator()(0, incidence, azimuth, kFootprint, {}).pulse.errors;
        const Vector3d g = Upward();
        survey.sum += by_waves, survey.squares += by_waves * by_waves, survey.stated += g.dot(of_waves * g);
        const Eigen::Matrix3d all = depth * depth * of_waves + others;
        survey.points.push_back({.x = reported.x(),
                                 .y = reported.y(),
                                 .z = reported.z(),
                                 .time = pulse.time,
                                 .pulse = static_cast<float>(std::pow(kPulseSigma.z(), 2)),
                                 .line = static_cast<float>(std::pow(line_sigma.z(), 2)),
                                 .survey = static_cast<float>(std::pow(survey_sigma.z(), 2)),
                                 .sea = static_cast<float>(depth * depth * of_waves(2, 2)),
                                 .xx = static_cast<float>(all(0, 0)),
                                 .yy = static_cast<float>(all(1, 1)),
                                 .xy = static_cast<float>(all(0, 1)),
                                 .xz = static_cast<float>(all(0, 2)),
                                 .yz = static_cast<float>(all(1, 2)),
                                 .incidence = static_cast<float>(incidence),
                                 .azimuth = static_cast<float>(azimuth),
                                 .footprint = static_cast<float>(kFootprint),
                                 .depth = static_cast<float>(depth),
                                 .bias = static_cast<float>(depth * pulse.Bias(root_of_slopes)),
                                 .flight_line = static_cast<std::uint16_t>(line.number),
                                 .source = 0});
      }
    }
  }
  survey.n = static_cast<double>(survey.points.size());
  std::ranges::sort(survey.points, {}, &SurfacePoint::Order);
  return survey;
}

}  // namespace albtpu::quality
