// A simulated survey, whose errors are drawn by the declared standard deviations: does the reported uncertainty hold 95
// % of the points?
//
// Errors of survey and line are drawn once for each line and are constant along it, those of a pulse anew. Points come
// from an exact forward model of the lidar. Waves are those of the Monte Carlo: each pulse is a beam that was traced
// through a realization of the sea. Its share is stated as a table would, from the sample itself.
//
// ALBTPU_SIMULATED_TOTALS=FILE.csv also writes what was found, for tests/validation/physics/draw_simulated_totals.py.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <vector>

#include "budget/total/budget_columns.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "tests/budget/air/air_forward.h"
#include "tests/validation/physics/traced_beams.h"

namespace albtpu {
namespace {

using Eigen::Vector3d;
using testing::kAirUnknowns;
using Unknowns = Eigen::Matrix<double, kAirUnknowns, 1>;

constexpr double kWind = 6, kFetch = 20'000, kFootprint = 0.6, kIndex = 1.33;
constexpr std::array<double, 4> kIncidences = {1, 10, 18, 25};  // degree
constexpr std::array<double, 3> kAzimuths = {0, 40, 80};        // degree from downwind
constexpr std::array<double, 4> kDepths = {1, 4, 10, 20};       // m
constexpr int kRealizations = 2000;
constexpr int kLines = 21'000, kPulsesOfLine = 48;  // 1 008 000 points

const AirErrors kErrors = {.position = {0.02, 0.02, 0.06},
                           .attitude = {0.005, 0.005, 0.008},
                           .boresight = {0.001, 0.001, 0.004},
                           .lever_arm = 0.02,
                           .scan = 0.01,
                           .time = 1e-5,
                           .range_offset = 0.01,
                           .bottom_range = 0.025,
                           .surface_range = 0.02,
                           .surface_height = 0.03,
                           .index = 0.002};

using testing::TracedErrors;

// By incidence, then azimuth.
std::vector<BeamOptions> Beams() {
  std::vector<BeamOptions> beams;
  for (const double incidence : kIncidences)
    for (const double azimuth : kAzimuths)
      beams.push_back(
          {.incidence = RadiansOfDegrees(incidence), .azimuth = RadiansOfDegrees(azimuth), .footprint = kFootprint});
  return beams;
}

// One sea for all tests.
const SeaState& Sea() {
  static const SeaState sea({.waves = WindSea{.wind_speed_10m = kWind, .fetch = kFetch, .model = &kElfouhailyModel}});
  return sea;
}
const std::vector<TracedErrors>& Traced() {
  static const std::vector<TracedErrors> traced =
      testing::TraceBeams(Sea(), {.beams = Beams(),
                                  .refractive_index = kIndex,
                                  .depths = {kDepths.begin(), kDepths.end()},
                                  .realizations = kRealizations,
                                  .rays = 600});
  return traced;
}

// Of a wave alone, on the axes of the sea.
Vector3d ErrorOf(const BeamErrors& wave, double depth, const BeamOptions& beam) {
  return testing::ErrorOfReportedPoint(wave, depth, beam, kIndex) -
         testing::ErrorOfReportedPoint({}, depth, beam, kIndex);
}

// The covariance of the contribution of the sea surface, made of THU, TVU and the two refractions, is that of the
// reported points of traced beams.
TEST(SeaContribution, HasTheCovarianceOfTracedBeams) {
  constexpr std::size_t kDepth = 2;
  const double depth = kDepths[kDepth];
  for (std::size_t t = 1; t < kIncidences.size(); ++t) {  // Near nadir TVU is of second order.
    for (std::size_t a = 0; a < kAzimuths.size(); ++a) {
      const TracedErrors& waves = Traced()[t * kAzimuths.size() + a];
      // On the axes of the sea, x downwind, which is north here; y to its left, which is west; up.
      Eigen::Matrix3d traced = Eigen::Matrix3d::Zero();
      for (const BeamErrors& e : waves.draws) {
        const Vector3d on_sea = ErrorOf(e, depth, Beams()[t * kAzimuths.size() + a]);
        const Vector3d error(on_sea.x(), -on_sea.y(), -on_sea.z());
        traced += error * error.transpose() / kRealizations;
      }
      const float incidence = static_cast<float>(kIncidences[t]), azimuth = static_cast<float>(-kAzimuths[a]);
      const std::array<float, 9> numbers = {incidence,
                                            azimuth,
                                            400,
                                            static_cast<float>(depth),
                                            static_cast<float>(waves.uncertainty.thu[kDepth].value),
                                            static_cast<float>(waves.uncertainty.tvu[kDepth].value),
                                            static_cast<float>(waves.uncertainty.refraction_along_wind.value),
                                            static_cast<float>(waves.uncertainty.refraction_cross_wind.value),
                                            0};
      BudgetInputs inputs{.size = 1};
      const BudgetInput given[] = {BudgetInput::kIncidence,       BudgetInput::kBeamAzimuth,     BudgetInput::kAltitude,
                                   BudgetInput::kDepth,           BudgetInput::kSeaThu,          BudgetInput::kSeaTvu,
                                   BudgetInput::kRefractionAlong, BudgetInput::kRefractionCross, BudgetInput::kSeaAxis};
      for (std::size_t i = 0; i < numbers.size(); ++i) inputs[given[i]] = std::span<const float>(&numbers[i], 1);
      std::array<float, 6> c;
      BudgetOutputs outputs;
      for (std::size_t i = 0; i < c.size(); ++i) outputs.sea[i] = std::span<float>(&c[i], 1);
      ComputeBudget(inputs, {.index = kIndex}, outputs);
      const auto near = [&](double ours, int row, int column) {
        const double scale = std::sqrt(traced(row, row) * traced(column, column));
        EXPECT_NEAR(ours / scale, traced(row, column) / scale, 0.03)
            << incidence << " " << azimuth << " " << row << column;
      };
      near(c[0], 0, 0);
      near(c[1], 1, 1);
      near(c[2], 2, 2);
      near(c[3], 0, 1);
      near(c[4], 0, 2);
      near(c[5], 1, 2);
      // TVU follows from the horizontal covariance in the plane of the beam where the first order dominates.
      const double sine = std::sin(RadiansOfDegrees(incidence)) / kIndex;
      const Eigen::Vector2d e(std::cos(RadiansOfDegrees(azimuth)), std::sin(RadiansOfDegrees(azimuth)));
      const Eigen::Matrix2d horizontal = (Eigen::Matrix2d() << c[0], c[3], c[3], c[1]).finished();
      const double along_beam = std::sqrt(e.dot(horizontal * e));
      const double to_up = sine / std::sqrt(1 - sine * sine);
      EXPECT_NEAR(to_up * along_beam / std::sqrt(c[2]), 1, 0.025) << incidence << " " << azimuth;
      std::printf("incidence %g, azimuth %g: TVU of the horizontal covariance over TVU %.4f\n", incidence, -azimuth,
                  to_up * along_beam / std::sqrt(c[2]));
    }
  }
}

// Shares of the points within the reported THU and TVU.
struct Held {
  double thu = 0, tvu = 0;
  int points = 0;

  void Add(bool in_thu, bool in_tvu) {
    thu += in_thu;
    tvu += in_tvu;
    ++points;
  }
};

class SimulatedTotals : public ::testing::TestWithParam<SurfaceLocation> {};

TEST_P(SimulatedTotals, Hold95PercentOfThePoints) {
  const SurfaceLocation located = GetParam();
  const std::vector<TracedErrors>& traced = Traced();
  const std::vector<BeamOptions> beams = Beams();
  const bool unseen = located != SurfaceLocation::kPulse;
  const double wave_height = std::sqrt(ElevationVariance(Sea()));
  std::mt19937_64 random(1 + static_cast<unsigned>(located));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const bool level = located == SurfaceLocation::kLevel;
  const auto draw = [&](double sigma) { return sigma * normal(random); };
  const BudgetOptions options = {.errors = kErrors,
                                 .located = located,
                                 .lever_arm = {0.3, -0.2, 0.5},
                                 .index = kIndex,
                                 .datum = 0.05,
                                 .coverage = Coverage::kP95};
  std::map<double, Held> by_depth, by_incidence;
  Held all;
  constexpr std::size_t kBlock = kPulsesOfLine;
  for (int line = 0; line < kLines; ++line) {
    Unknowns constant = Unknowns::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      constant[testing::kNorth + axis] = draw(kErrors.position[axis]);
      constant[testing::kRoll + axis] = draw(RadiansOfDegrees(kErrors.attitude[axis]));
      constant[testing::kBoresightX + axis] = draw(RadiansOfDegrees(kErrors.boresight[axis]));
      constant[testing::kLeverX + axis] = draw(kErrors.lever_arm);
    }
    constant[testing::kTime] = draw(kErrors.time);
    constant[testing::kRangeOffset] = draw(kErrors.range_offset);
    constant[testing::kIndex] = draw(kErrors.index);
    const double surface = draw(kErrors.surface_height), datum = draw(options.datum);
    const double heading = 360 * uniform(random), altitude = 300 + 300 * uniform(random);
    const double downwind = 360 * uniform(random);
    std::array<std::vector<float>, kBudgetInputCount> columns;
    const auto put = [&](BudgetInput input, double number) {
      columns[static_cast<std::size_t>(input)].push_back(static_cast<float>(number));
    };
    std::vector<Vector3d> errors;
    std::vector<double> depths, incidences;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const std::size_t t = i % kIncidences.size(), d = (i / kIncidences.size()) % kDepths.size();
      const std::size_t a = (i / (kIncidences.size() * kDepths.size())) % kAzimuths.size();
      const TracedErrors& waves = traced[t * kAzimuths.size() + a];
      const double depth = kDepths[d];
      // The sea turns against the compass: azimuth from downwind is counter-clockwise.
      const AirPulse pulse = {
          .incidence = kIncidences[t],
          .beam_azimuth = downwind - kAzimuths[a],
          .altitude = altitude,
          .depth = depth,
          .roll = 3 * normal(random),
          .pitch = 3 * normal(random),
          .heading = heading,
          .velocity = {70 * std::cos(RadiansOfDegrees(heading)), 70 * std::sin(RadiansOfDegrees(heading)), 0},
          .rates = {normal(random), normal(random), normal(random)},
          .lever_arm = Vector3d(options.lever_arm.data()),
          .index = kIndex};
      Unknowns own = constant, scan = Unknowns::Zero();
      own[testing::kBottomRange] = draw(kErrors.bottom_range);
      double height = located == SurfaceLocation::kPulse ? draw(kErrors.surface_height) : surface;
      if (located == SurfaceLocation::kPulse)
        height += draw(kErrors.surface_range) * std::cos(RadiansOfDegrees(pulse.incidence));
      if (unseen) height += draw(wave_height);
      own[testing::kSurfaceHeight] = height;
      // A model of many returns does not follow the scan angle of this one.
      scan[testing::kScanA] = draw(RadiansOfDegrees(kErrors.scan));
      scan[testing::kScanB] = draw(RadiansOfDegrees(kErrors.scan));
      const Vector3d truth = testing::ReportedPoint<double>(pulse, level, Unknowns::Zero());
      Vector3d error = testing::ReportedPoint<double>(pulse, level, own) - truth;
      error += testing::ReportedPoint<double>(pulse, located != SurfaceLocation::kPulse, scan) - truth;
      const BeamErrors& wave = waves.draws[random() % waves.draws.size()];
      const Vector3d on_sea = ErrorOf(wave, depth, beams[t * kAzimuths.size() + a]);
      const double c = std::cos(RadiansOfDegrees(downwind)), s = std::sin(RadiansOfDegrees(downwind));
      error += Vector3d(c * on_sea.x() + s * on_sea.y(), s * on_sea.x() - c * on_sea.y(), -on_sea.z());
      error.z() += datum;
      errors.push_back(error);
      depths.push_back(depth);
      incidences.push_back(pulse.incidence);
      put(BudgetInput::kIncidence, pulse.incidence);
      put(BudgetInput::kBeamAzimuth, pulse.beam_azimuth);
      put(BudgetInput::kAltitude, altitude);
      put(BudgetInput::kDepth, depth);
      put(BudgetInput::kRoll, pulse.roll);
      put(BudgetInput::kPitch, pulse.pitch);
      put(BudgetInput::kHeading, heading);
      put(BudgetInput::kVelocityNorth, pulse.velocity[0]);
      put(BudgetInput::kVelocityEast, pulse.velocity[1]);
      put(BudgetInput::kVelocityDown, pulse.velocity[2]);
      put(BudgetInput::kRollRate, pulse.rates[0]);
      put(BudgetInput::kPitchRate, pulse.rates[1]);
      put(BudgetInput::kYawRate, pulse.rates[2]);
      put(BudgetInput::kSeaThu, waves.uncertainty.thu[d].value);
      put(BudgetInput::kSeaTvu, waves.uncertainty.tvu[d].value);
      put(BudgetInput::kRefractionAlong, DegreesOfRadians(waves.uncertainty.refraction_along_wind.value));
      put(BudgetInput::kRefractionCross, DegreesOfRadians(waves.uncertainty.refraction_cross_wind.value));
      put(BudgetInput::kSeaAxis, downwind);
      put(BudgetInput::kWaveHeight, unseen ? wave_height : 0);
    }
    BudgetInputs inputs{.size = kBlock};
    for (std::size_t i = 0; i < kBudgetInputCount; ++i) inputs.columns[i] = columns[i];
    std::array<float, kBlock> thu, tvu;
    ComputeBudget(inputs, options, {.thu = thu, .tvu = tvu});
    for (std::size_t i = 0; i < kBlock; ++i) {
      const bool in_thu = errors[i].head<2>().norm() <= thu[i], in_tvu = std::abs(errors[i].z()) <= tvu[i];
      by_depth[depths[i]].Add(in_thu, in_tvu);
      by_incidence[incidences[i]].Add(in_thu, in_tvu);
      all.Add(in_thu, in_tvu);
    }
  }
  std::ofstream csv;
  if (const char* path = std::getenv("ALBTPU_SIMULATED_TOTALS"); path != nullptr) csv.open(path, std::ios::app);
  const auto check = [&](const char* by, double at, const Held& held) {
    const double thu = 100 * held.thu / held.points, tvu = 100 * held.tvu / held.points;
    const std::string name(kSurfaceLocationNames[static_cast<std::size_t>(located)]);
    std::printf("%-6s %-10s %4g: %.2f %% within THU, %.2f %% within TVU, %d points\n", name.c_str(), by, at, thu, tvu,
                held.points);
    if (csv.is_open()) csv << name << "," << by << "," << at << "," << thu << "," << tvu << "\n";
    EXPECT_NEAR(thu, 95, 0.5) << name << " " << by << " " << at;
    EXPECT_NEAR(tvu, 95, 0.5) << name << " " << by << " " << at;
  };
  check("all", 0, all);
  for (const auto& [depth, held] : by_depth) check("depth", depth, held);
  for (const auto& [incidence, held] : by_incidence) check("incidence", incidence, held);
}

INSTANTIATE_TEST_SUITE_P(Located, SimulatedTotals,
                         ::testing::Values(SurfaceLocation::kPulse, SurfaceLocation::kLocal, SurfaceLocation::kLevel),
                         [](const auto& test) {
                           return std::string(kSurfaceLocationNames[static_cast<std::size_t>(test.param)]);
                         });

}  // namespace
}  // namespace albtpu
