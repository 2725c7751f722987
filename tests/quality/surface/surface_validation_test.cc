// Simulated surveys with truth: do the uncertainties of nodes hold?
//
// Waves travel: each is drawn anew for every survey, and every pulse meets them at its own place and time. A pulse is
// refracted by the law of Snell at the slope that its footprint averages, and reported as processing would, with errors
// of its own, of its line and of the survey. No covariance of two pulses is used.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "quality/surface/sea_sharing.h"
#include "quality/surface/surface_tile.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu::quality {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFootprint = 0.6, kIncidence = 20, kIndex = 1.34;
constexpr double kShortest = 30;  // rad/m: the footprint hides what is shorter, of the waves that are drawn and stated.
const Vector2d kSlope(0.15, -0.1);
constexpr double kDepth = 8;              // m, in the middle
constexpr double kWest = 4, kWidth = 12;  // m: where the points lie.
const Vector3d kPulseSigma(0.04, 0.04, 0.03), kLineSigma(0.03, 0.03, 0.05), kSurveySigma(0.05, 0.02, 0.02);

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

// What a line sees of the place in one direction: the fore and the aft part of a scan are two.
struct Look {
  int line;
  double azimuth, start;  // degree clockwise from north; s
  double spacing;         // m between pulses
};

class SimulatedPlace {
 public:
  explicit SimulatedPlace(std::vector<Look> looks) : looks_(std::move(looks)), sea_(Sea()) {
    source_ = sharing_at(1).Add({.spectrum = sea_, .x_azimuth = std::numbers::pi / 2, .water_index = kIndex});
  }
  SeaSharing& sharing_at(double cell) {
    for (auto& [side, sharing] : sharing_)
      if (side == cell) return *sharing;
    sharing_.emplace_back(cell, std::make_unique<SeaSharing>(cell));
    if (cell != 1)
      sharing_.back().second->Add({.spectrum = sea_, .x_azimuth = std::numbers::pi / 2, .water_index = kIndex});
    return *sharing_.back().second;
  }

  std::vector<SurfacePoint> Survey(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    TravellingWaves waves(sea_, random);
    const Vector3d of_survey = Draw(kSurveySigma, random);
    const std::array<Vector3d, 3> of_lines = {Vector3d::Zero(), Draw(kLineSigma, random), Draw(kLineSigma, random)};
    std::uniform_real_distribution<double> jitter(-0.4, 0.4);
    std::vector<SurfacePoint> points;
    for (const Look& look : looks_) {
      const double azimuth = RadiansOfDegrees(90 - look.azimuth), incidence = RadiansOfDegrees(kIncidence);
      const BeamOptions beam{.incidence = incidence, .azimuth = azimuth, .footprint = kFootprint};
      waves.Weight(beam);
      const Vector2d along(std::cos(azimuth), std::sin(azimuth));
      const Vector3d incident(std::sin(incidence) * along.x(), std::sin(incidence) * along.y(), -std::cos(incidence));
      const double still = StillWaterRefraction(incidence, kIndex);
      // What waves do to one pulse, per depth^2: at the middle of the table, where pulse and cell are at hand.
      const Eigen::Matrix3d of_waves = sharing_at(1)(source_, kIncidence, look.azimuth, kFootprint).pulse;
      for (double y = 0; y < kWidth; y += look.spacing)
        for (double x = 0; x < kWidth; x += look.spacing) {
          const Vector2d truth =
              Vector2d(kWest + x, kWest + y) + look.spacing * Vector2d(jitter(random), jitter(random));
          const double height = HeightAt(truth), depth = -height;
          // 50 m/s along y; a scan line takes 1 ms.
          const double time = look.start + truth.y() / 50 + 1e-4 * truth.x();
          const RefractedRay ray =
              RefractAtSlope(incident, waves.SlopeAt(truth - depth * std::tan(still) * along, time), kIndex);
          const double of_path = depth * (1 - ray.secant * std::cos(still));
          drawn_.sum += of_path / depth, drawn_.squares += of_path * of_path / depth / depth, ++drawn_.n;
          drawn_.stated += of_waves(2, 2);
          Vector3d error = Draw(kPulseSigma, random) + of_lines[static_cast<std::size_t>(look.line)] + of_survey;
          error.head<2>() += depth * (ray.secant * std::sin(still) * along - ray.tangent);
          error.z() += of_path;
          const Vector3d others = kPulseSigma.cwiseAbs2() + kLineSigma.cwiseAbs2() + kSurveySigma.cwiseAbs2();
          const Eigen::Matrix3d all = depth * depth * of_waves + Eigen::Matrix3d(others.asDiagonal());
          points.push_back({.x = truth.x() + error.x(),
                            .y = truth.y() + error.y(),
                            .z = height + error.z(),
                            .time = time,
                            .pulse = static_cast<float>(std::pow(kPulseSigma.z(), 2)),
                            .line = static_cast<float>(std::pow(kLineSigma.z(), 2)),
                            .survey = static_cast<float>(std::pow(kSurveySigma.z(), 2)),
                            .sea = static_cast<float>(depth * depth * of_waves(2, 2)),
                            .xx = static_cast<float>(all(0, 0)),
                            .yy = static_cast<float>(all(1, 1)),
                            .xy = static_cast<float>(all(0, 1)),
                            .xz = static_cast<float>(all(0, 2)),
                            .yz = static_cast<float>(all(1, 2)),
                            .incidence = static_cast<float>(kIncidence),
                            .azimuth = static_cast<float>(look.azimuth),
                            .footprint = static_cast<float>(kFootprint),
                            .depth = static_cast<float>(depth),
                            .flight_line = static_cast<std::uint16_t>(look.line),
                            .source = source_});
        }
    }
    std::ranges::sort(points, {}, &SurfacePoint::Order);
    return points;
  }

  // Of the sea in single pulses: the drawn variance over the stated one.
  double DrawnOverStated() const {
    const double mean = drawn_.sum / drawn_.n;
    return (drawn_.squares / drawn_.n - mean * mean) / (drawn_.stated / drawn_.n);
  }

  static double HeightAt(const Vector2d& at) { return -kDepth + kSlope.dot(at - Vector2d(10, 10)); }

 private:
  std::vector<Look> looks_;
  HarmonicSpectrum sea_;
  std::vector<std::pair<double, std::unique_ptr<SeaSharing>>> sharing_;
  std::uint16_t source_ = 0;
  struct {
    double sum = 0, squares = 0, stated = 0, n = 0;
  } drawn_;
};

// Errors of the nodes of many surveys, less their mean, which is bias: waves make paths longer.
class NodeErrors {
 public:
  void Add(const SurfaceNode& node, double truth) {
    const NodeVariance& v = node.variance;
    nodes_.push_back({node.elevation - truth, v.total(), (v.of_point + v.survey) / node.points, v.of_point + v.survey,
                      node.deviation * node.deviation / v.within_cell(node.points)});
    mean_ += nodes_.back()[0];
  }
  std::size_t size() const { return nodes_.size(); }

  // Normalized variances, and the fraction of nodes within 1.96 standard deviations.
  struct Found {
    double ours = 0, independent = 0, mean_of_points = 0, within_cells = 0, held = 0;
  };
  Found Normalized() const {
    Found found;
    const auto n = static_cast<double>(nodes_.size());
    for (const auto& [error, ours, independent, of_points, within] : nodes_) {
      const double squared = std::pow(error - mean_ / n, 2);
      found.ours += squared / ours / n, found.independent += squared / independent / n;
      found.mean_of_points += squared / of_points / n;
      found.within_cells += within / n;
      found.held += (squared < std::pow(1.959964, 2) * ours) / n;
    }
    return found;
  }

 private:
  std::vector<std::array<double, 5>> nodes_;  // Error; variances: ours, independent, mean TVU; that within cells.
  double mean_ = 0;
};

int Surveys() { return std::getenv("ALBTPU_EVERY_CASE") != nullptr ? 4000 : 200; }

TEST(NodesOfSurveys, LieWithinTheirUncertainty) {
  constexpr std::array kCells = {0.5, 1.0, 2.0};
  SimulatedPlace place({{1, 30, 0, 0.5}, {1, 210, 8, 0.45}, {2, 120, 60, 0.4}});
  const Vector3d of_pulse = kPulseSigma.cwiseAbs2(), of_line = kLineSigma.cwiseAbs2(),
                 of_survey = kSurveySigma.cwiseAbs2();
  const double all = (of_pulse + of_line + of_survey).head<2>().sum();
  const HorizontalGroups groups = {.pulse = of_pulse.head<2>().sum() / all,
                                   .line = of_line.head<2>().sum() / all,
                                   .survey = of_survey.head<2>().sum() / all};
  std::array<NodeErrors, kCells.size()> errors;
  for (int seed = 1; seed <= Surveys(); ++seed) {
    const std::vector<SurfacePoint> points = place.Survey(static_cast<std::uint64_t>(seed));
    for (std::size_t c = 0; c < kCells.size(); ++c) {
      const double cell = kCells[c], margin = 1.5 * cell + 0.5;  // Their neighbours are full of points, too.
      const SeaSharing& sharing = place.sharing_at(cell);
      const std::vector<SurfaceNode> nodes =
          NodesOf({}, points, cell, 1,
                  {.sea = [&](auto... beam) { return sharing(beam...); }, .groups = [&](auto) { return groups; }});
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vector2d at(cell * (static_cast<double>(i % kTileCells) + 0.5),
                          cell * (static_cast<double>(i / kTileCells) + 0.5));
        if (at.minCoeff() < kWest + margin || at.maxCoeff() > kWest + kWidth - margin || nodes[i].points < 3) continue;
        errors[c].Add(nodes[i], SimulatedPlace::HeightAt(at));
      }
    }
  }
  // The nodes of one survey share its errors, so that there are about as many independent ones as surveys.
  const double standard_error = std::sqrt(2.0 / Surveys());
  for (std::size_t c = 0; c < kCells.size(); ++c) {
    const NodeErrors::Found found = errors[c].Normalized();
    std::printf(
        "cells of %.1f m, %zu nodes of %d surveys: normalized variance %.3f, %.1f %% within 95 %%; points as "
        "independent %.2f, mean TVU %.2f; scatter in cells %.3f\n",
        kCells[c], errors[c].size(), Surveys(), found.ours, 100 * found.held, found.independent, found.mean_of_points,
        found.within_cells);
    EXPECT_NEAR(found.ours, 1, 3 * standard_error) << kCells[c];
    EXPECT_NEAR(found.within_cells, 1, 1.5 * standard_error) << kCells[c];
    EXPECT_GT(found.independent, 1.8) << kCells[c];
    EXPECT_LT(found.mean_of_points, 0.6) << kCells[c];
  }
  EXPECT_NEAR(place.DrawnOverStated(), 1, 3 * standard_error / 10) << "the sea's share of single pulses";
}

}  // namespace
}  // namespace albtpu::quality
