// The covariance and the biases of a total are those of the point that is reported: waves are traced with exact
// refraction, the other errors drawn by their own covariance, and the squared distance of each point from the truth, in
// units of the covariance of the budget, has the mean 3.
//
// ALBTPU_EVERY_CASE=1 traces more realizations and directions, and states the share of the sea by the response theory,
// which knows nothing of what was traced.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "budget/total/budget_columns.h"
#include "budget/total/reported_point.h"
#include "sea/angle.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "tests/every_case.h"
#include "tests/validation/physics/traced_beams.h"

namespace albtpu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kIndex = 1.34, kAltitude = 400;
const std::vector<double> kDepths = {1, 5, 10, 20};  // m

using albtpu::testing::EveryCase;

struct System {
  const char* name;
  AirErrors errors;
};
const std::array<System, 2> kSystems = {{{"good",
                                          {.position = {0.02, 0.02, 0.04},
                                           .attitude = {0.0025, 0.0025, 0.005},
                                           .boresight = {0.001, 0.001, 0.003},
                                           .scan = 0.003,
                                           .bottom_range = 0.02,
                                           .surface_range = 0.015}},
                                         {"very good",
                                          {.position = {0.01, 0.01, 0.02},
                                           .attitude = {0.001, 0.001, 0.002},
                                           .scan = 0.001,
                                           .bottom_range = 0.01,
                                           .surface_range = 0.01}}}};

const WindSea kWaves = {.wind_speed_10m = 6, .fetch = 20'000, .model = &kElfouhailyModel};

const SeaState& Sea() {
  static const SeaState sea({.waves = kWaves});
  return sea;
}

const testing::Tracing& Asked() {
  static const testing::Tracing asked = [] {
    testing::Tracing tracing{.beams = {},
                             .refractive_index = kIndex,
                             .depths = kDepths,
                             .realizations = EveryCase() ? 12'000 : 400,
                             .rays = EveryCase() ? 400 : 200};
    // Along an axis of the sea the covariance needs no more than the sample has.
    const std::vector<double> azimuths = EveryCase() ? std::vector<double>{0, 40, 90} : std::vector<double>{0};
    for (const double incidence : {5, 15, 25})
      for (const double azimuth : azimuths)
        tracing.beams.push_back(
            {.incidence = RadiansOfDegrees(incidence), .azimuth = RadiansOfDegrees(azimuth), .footprint = 0.6});
    return tracing;
  }();
  return asked;
}

const std::vector<testing::TracedErrors>& Traced() {
  static const std::vector<testing::TracedErrors> traced = TraceBeams(Sea(), Asked());
  return traced;
}

// The share of the sea: THU, TVU, and refraction along and across the wind.
using Share = std::array<double, 4>;

Share ShareOfTheSample(const testing::TracedErrors& waves, std::size_t depth) {
  const BeamUncertainty& u = waves.uncertainty;
  return {u.thu[depth].value, u.tvu[depth].value, DegreesOfRadians(u.refraction_along_wind.value),
          DegreesOfRadians(u.refraction_cross_wind.value)};
}

Share ShareOfTheTheory(const BeamOptions& beam, double depth) {
  static const SeaResponse response(Sampled(*kWaves.MakeSpectrum(), SeaWavenumbers(), 3), kIndex);
  const BeamResponse of = response(beam);
  return {of.Thu(depth), of.Tvu(depth), DegreesOfRadians(of.refraction_along_wind()),
          DegreesOfRadians(of.refraction_cross_wind())};
}

struct Covariances {
  Matrix3d air, total;
};

// North is downwind, so that azimuths count against the compass.
Covariances BudgetOf(const BeamOptions& beam, double depth, const Share& share, const AirErrors& errors) {
  const std::array<std::pair<BudgetInput, double>, 9> given = {
      {{BudgetInput::kIncidence, DegreesOfRadians(beam.incidence)},
       {BudgetInput::kBeamAzimuth, -DegreesOfRadians(beam.azimuth)},
       {BudgetInput::kAltitude, kAltitude},
       {BudgetInput::kDepth, depth},
       {BudgetInput::kSeaThu, share[0]},
       {BudgetInput::kSeaTvu, share[1]},
       {BudgetInput::kRefractionAlong, share[2]},
       {BudgetInput::kRefractionCross, share[3]},
       {BudgetInput::kSeaAxis, 0}}};
  std::array<float, 9> numbers;
  BudgetInputs inputs{.size = 1};
  for (std::size_t i = 0; i < given.size(); ++i) {
    numbers[i] = static_cast<float>(given[i].second);
    inputs[given[i].first] = std::span<const float>(&numbers[i], 1);
  }
  std::array<float, 6> air, total;
  BudgetOutputs outputs;
  for (std::size_t i = 0; i < 6; ++i) {
    outputs.air[i] = std::span<float>(&air[i], 1);
    outputs.total[i] = std::span<float>(&total[i], 1);
  }
  ComputeBudget(inputs, {.errors = errors, .index = kIndex}, outputs);
  const auto matrix = [](const std::array<float, 6>& c) {
    return (Matrix3d() << c[0], c[3], c[4], c[3], c[1], c[5], c[4], c[5], c[2]).finished();
  };
  return {matrix(air), matrix(total)};
}

// On the axes north, east, down.
Vector3d OnCompass(const Vector3d& on_sea) { return {on_sea.x(), -on_sea.y(), -on_sea.z()}; }

TEST(ReportedPoint, IsAsFarFromTheTruthAsTheBudgetSays) {
  constexpr int kDraws = 30;  // of the other errors, at each realization of the sea
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (const System& system : kSystems) {
    for (std::size_t b = 0; b < Asked().beams.size(); ++b) {
      const BeamOptions& beam = Asked().beams[b];
      for (std::size_t d = 0; d < kDepths.size(); ++d) {
        const Share share = EveryCase() ? ShareOfTheTheory(beam, kDepths[d]) : ShareOfTheSample(Traced()[b], d);
        const Covariances c = BudgetOf(beam, kDepths[d], share, system.errors);
        const Eigen::LLT<Matrix3d> root(c.air), whole(c.total);
        double sum = 0;
        int count = 0;
        for (const BeamErrors& wave : Traced()[b].draws) {
          const Vector3d of_waves = OnCompass(testing::ErrorOfReportedPoint(wave, kDepths[d], beam, kIndex) -
                                              testing::ErrorOfReportedPoint({}, kDepths[d], beam, kIndex));
          for (int draw = 0; draw < kDraws; ++draw, ++count) {
            const Vector3d others = root.matrixL() * Vector3d(normal(random), normal(random), normal(random));
            const Vector3d error = of_waves + others;
            sum += error.dot(whole.solve(error));
          }
        }
        const std::string where =
            std::string(system.name) + ", incidence " + std::to_string(DegreesOfRadians(beam.incidence)) +
            ", azimuth " + std::to_string(DegreesOfRadians(beam.azimuth)) + ", depth " + std::to_string(kDepths[d]);
        std::printf("%s: chi-square %.3f\n", where.c_str(), sum / count);
        EXPECT_NEAR(sum / count, 3, 0.05) << where;
      }
    }
  }
}

// The mean errors of the spot on a level bottom, restated, are the mean errors of the reported points.
TEST(ReportedPoint, HasTheBiasThatIsStated) {
  for (std::size_t b = 0; b < Asked().beams.size(); ++b) {
    const BeamOptions& beam = Asked().beams[b];
    const testing::TracedErrors& waves = Traced()[b];
    const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth));
    for (std::size_t d = 0; d < kDepths.size(); ++d) {
      const Vector3d truth = testing::ErrorOfReportedPoint(waves.mean, kDepths[d], beam, kIndex);
      const float stated = ReportedBiasAlong(static_cast<float>(waves.uncertainty.bias_along_beam[d].value),
                                             static_cast<float>(waves.uncertainty.bias_vertical[d].value),
                                             DegreesOfRadians(beam.incidence), kIndex);
      EXPECT_NEAR(stated, along.dot(truth.head<2>()), 1e-6 * kDepths[d]);
    }
  }
}

}  // namespace
}  // namespace albtpu
