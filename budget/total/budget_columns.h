// The total uncertainty of many pulses: the contributions of air side, sea surface, water column and datum, and what
// the surveyor adds, added as covariances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "budget/air/air_errors.h"
#include "sea/water_index.h"
#include "tables/coverage.h"

namespace albtpu {

// The inputs of a pulse. A column has one number for each pulse, one for all, or none where the comment says what none
// means.
enum class BudgetInput : std::uint8_t {
  kIncidence,    // degree from the vertical, in air: 0 or more, below 90.
  kBeamAzimuth,  // degree, clockwise from true north: where the beam travels to. None: not known, lengths are right.
  kAltitude,     // m, of the sensor above the water: above 0.
  kDepth,        // m, below the water: 0 or more.
  // The aircraft. None: 0. The heading matters where lever arm, boresight, roll and pitch differ from each other.
  kRoll,           // degree
  kPitch,          // degree
  kHeading,        // degree, clockwise from true north.
  kVelocityNorth,  // m/s
  kVelocityEast,   // m/s
  kVelocityDown,   // m/s
  kRollRate,       // degree/s, about the forward axis of the aircraft.
  kPitchRate,      // degree/s, about its right axis.
  kYawRate,        // degree/s, about its down axis.
  // Standard deviations of the trajectory at this pulse. None: those of AirErrors.
  kPositionSigmaNorth,  // m
  kPositionSigmaEast,   // m
  kPositionSigmaDown,   // m
  kRollSigma,           // degree
  kPitchSigma,          // degree
  kHeadingSigma,        // degree
  // The contribution of the sea surface at 2 sigma, as a table answers it (tables/pulse.h). NaN: no answer.
  kSeaThu,           // m
  kSeaTvu,           // m
  kRefractionAlong,  // degree, along the axis of the sea.
  kRefractionCross,  // degree, across it.
  kBiasAlongBeam,    // m, of the reported point (reported_point.h). None or NaN: not known, taken as 0.
  kBiasVertical,     // m. None or NaN: not known, taken as 0.
  kSeaAxis,     // degree, clockwise from true north. None or NaN: not known; then errors are alike in all directions.
  kWaveHeight,  // m, standard deviation of the waves that the located surface does not follow. None: 0.
  // The contribution of the water column at 1 sigma (budget/water). None: 0, it is left out. NaN: no answer.
  kWaterSigmaAlong,     // m, along the beam, of all pulses of a survey alike.
  kWaterSigmaVertical,  // m, the same, vertical.
  kWaterCorrelation,    // of the two, too far along with too shallow: -1 to 1; beyond counts as the nearer end.
  kWaterNoise,          // m, vertical, of the photons of this echo alone.
  kWaterBiasAlong,      // m, as kBiasAlongBeam, to which it is added.
  kWaterBiasVertical,   // m, as kBiasVertical, to which it is added.
};
inline constexpr std::size_t kBudgetInputCount = 33;
// clang-format off
inline constexpr std::array<std::string_view, kBudgetInputCount> kBudgetInputNames = {
    "incidence", "beam_azimuth", "altitude", "depth", "roll", "pitch", "heading", "velocity_north", "velocity_east",
    "velocity_down", "roll_rate", "pitch_rate", "yaw_rate", "position_sigma_north", "position_sigma_east",
    "position_sigma_down", "roll_sigma", "pitch_sigma", "heading_sigma", "sea_thu", "sea_tvu", "refraction_along",
    "refraction_cross", "bias_along_beam", "bias_vertical", "sea_axis", "wave_height", "water_sigma_along",
    "water_sigma_vertical", "water_correlation", "water_noise", "water_bias_along", "water_bias_vertical"};
// clang-format on

struct BudgetInputs {
  std::size_t size = 0;
  std::array<std::span<const float>, kBudgetInputCount> columns = {};

  std::span<const float>& operator[](BudgetInput input) { return columns[static_cast<std::size_t>(input)]; }
  std::span<const float> operator[](BudgetInput input) const { return columns[static_cast<std::size_t>(input)]; }
};

constexpr BudgetInput operator+(BudgetInput first, std::size_t places) {
  return static_cast<BudgetInput>(static_cast<std::size_t>(first) + places);
}

// Inputs in memory of their own. From kRoll on come kMotionInputs columns of the motion of the aircraft and its sigmas.
struct AircraftColumns {
  std::array<std::vector<float>, kBudgetInputCount> columns;

  std::vector<float>& operator[](BudgetInput input) { return columns[static_cast<std::size_t>(input)]; }
  const std::vector<float>& operator[](BudgetInput input) const { return columns[static_cast<std::size_t>(input)]; }
};
inline constexpr std::size_t kMotionInputs = 15;
static_assert(BudgetInput::kRoll + (kMotionInputs - 1) == BudgetInput::kHeadingSigma);

// Constants of all pulses.
struct BudgetOptions {
  AirErrors errors = {};
  SurfaceLocation located = SurfaceLocation::kPulse;
  std::array<double, 3> lever_arm = {};  // m; forward, right, down, from the trajectory's point to the sensor.
  double index = kSeaWaterIndex;         // Refractive index of the water: 1 or more.
  double datum = 0;                      // m, standard deviation of the height of the vertical datum.
  // m, standard deviations that are added to all points, common to a survey. The horizontal one is radial, as THU at 1
  // sigma: the root of the sum of the variances along north and east, which are equal.
  double extra_horizontal = 0, extra_vertical = 0;
  Coverage coverage = Coverage::kTwoSigma;
};

// The entries of a symmetric matrix, m^2, 1 sigma; axes north, east, down. In the order of kCovarianceNames.
using CovarianceColumns = std::array<std::span<float>, 6>;
inline constexpr std::array<std::string_view, 6> kCovarianceNames = {"NN", "EE", "DD", "NE", "ND", "ED"};

// One number for each pulse; an empty column is not written. NaN where an input is NaN that a number depends on.
//
// THU and TVU at 2 sigma: twice the root of the trace of the horizontal covariance, and of its vertical entry. At 95 %:
// the radius that holds 95 % of the two-dimensional normal distribution with this covariance, and 1.96 standard
// deviations. At 1 sigma half of 2 sigma.
struct BudgetOutputs {
  std::span<float> thu = {}, tvu = {};                           // m, of all contributions.
  std::span<float> thu_air = {}, tvu_air = {};                   // m, of the air side alone.
  std::span<float> thu_sea = {}, tvu_sea = {};                   // m, of sea surface and unseen waves.
  std::span<float> thu_water = {}, tvu_water = {};               // m, of the water column.
  CovarianceColumns air = {}, sea = {}, water = {}, total = {};  // Of contributions and their sum.
  std::array<CovarianceColumns, kErrorGroups> groups = {};       // Of the total, by ErrorGroup.
  // 0: none; otherwise 1 plus the number of the strictest order of S-44 (kS44Orders) whose limits exceed the total at
  // 95 % plus the magnitude of the bias, horizontally and vertically.
  std::span<std::uint8_t> best_orders = {};
};

// Computes `outputs` for all pulses. Allocates nothing. Each pulse depends on its own numbers alone, and has the same
// bits on every processor.
//
//     C = C_air + C_sea + C_water + diag(0, 0, datum^2) + C_extra,    C_extra = diag(h^2 / 2, h^2 / 2, v^2)
//
// C_air as in budget/air. Horizontally, C_sea has the trace (THU/2)^2, variances along and across the axis of the sea
// in the proportion of the squared refractions, and the covariance of the two that Snell's law makes of uncorrelated
// slopes; vertically (TVU/2)^2; the covariance of the two is that of Snell's law to second order in slope
// (docs/budget.md). All this is of the table's spot on a level bottom, and is restated for the reported point
// (reported_point.h), of which all outputs are. Waves
// that the located surface does not follow add as an error of its height. C_water is in the plane of the beam: the
// uncertainty of the water's bias, common to all pulses, and the noise of a range along the refracted ray. Biases are
// in no covariance.
//
// Errors of rounding are below 1e-5 of the standard deviations.
void ComputeBudget(const BudgetInputs& inputs, const BudgetOptions& options, const BudgetOutputs& outputs);

// THU and TVU of C_extra alone, m, at the coverage of the options.
struct ExtraUncertainty {
  float thu = 0, tvu = 0;
};
ExtraUncertainty ExtraOf(const BudgetOptions& options);

}  // namespace albtpu
