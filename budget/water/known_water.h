// A described water: everything that determines what a total takes of it, and the water that is compiled from it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/air/air_errors.h"
#include "budget/water/green_surface.h"
#include "budget/water/refractive_index.h"
#include "budget/water/water_contribution.h"
#include "budget/water/water_optics.h"
#include "budget/water/water_receiver.h"

namespace albtpu {

// Equal waters and equal tables of the water column have the same share, bit for bit on the same instruction set: in a
// file, in process and on a server.
struct KnownWater {
  OpticsInput optics = {};
  // The receiver. The index of the group is that of temperature and salinity, or of sea water.
  EchoDetector detector = EchoDetector::kPeak;
  double field_of_view = 0, pulse_length = 0;  // m, ns
  // What the processing did about scattering between surface and bottom. Absent: its share is left out.
  std::optional<BiasTreatment> bias = {};
  std::optional<double> photons = {};         // counted in an echo; with a bias treatment
  std::optional<double> temperature = {};     // degree C
  std::optional<double> salinity = {};        // 1; with the temperature
  std::optional<double> processed_with = {};  // the index that ranges were computed with; needs both above
  bool green_surface = false;                 // A green laser located the surface by its returns.

  // By temperature and salinity, if both are known.
  std::optional<WaterIndex> index() const;
};

// The numbers that a water can have. Pure water attenuates by more than 0.001 1/m at all wavelengths that pass.
// Natural water is no warmer than 40 degrees and the salt of the ocean 45 at most; it freezes above -2. The offset of a
// calibration may be negative; none that a survey had was beyond metres.
struct WaterRange {
  double least, greatest;
  std::string_view unit;  // "1": none
};
inline constexpr WaterRange kKdRange = {0.001, 10, "1/m"}, kKdSigmaRange = {0, 10, "1/m"};
inline constexpr WaterRange kSecchiRange = {0.1, 80, "m"};
inline constexpr WaterRange kAbsorptionRange = {0.001, 10, "1/m"}, kScatteringRange = {0.001, 50, "1/m"};
inline constexpr WaterRange kAlbedoRange = {0.05, 0.98, "1"}, kAlbedoSigmaRange = {0, 0.3, "1"};
inline constexpr WaterRange kBackscatterRange = {0.005, 0.05, "1"};
inline constexpr WaterRange kFieldOfViewRange = {0.1, 1000, "m"}, kPulseLengthRange = {0.1, 20, "ns"};
inline constexpr WaterRange kPhotonsRange = {1, 1e9, "1"};
inline constexpr WaterRange kTemperatureRange = {-2, 40, "degree C"}, kSalinityRange = {0, 45, "1"};
// Fresh water at 30 degrees and 1064 nm has 1.32, cold sea water at 355 nm 1.36.
inline constexpr WaterRange kWaterIndexRange = {1.3, 1.4, "1"};
inline constexpr WaterRange kFractionRange = {0, 1, "1"};
inline constexpr WaterRange kCalibrationDepthRange = {0.1, 100, "m"}, kCalibrationOffsetRange = {-10, 10, "m"},
                            kCalibrationSigmaRange = {0, 10, "m"};

// What a total takes of a water.
struct CompiledWater {
  std::optional<WaterOptics> optics = {};                    // of the share and of the surface
  std::shared_ptr<const WaterContribution> share = nullptr;  // null: left out
  std::optional<double> photons = {};                        // counted in an echo
  // Where the processing used another index than that of the water.
  std::optional<WaterIndex> of_water = {};
  double processed_with = 0;
  std::optional<GreenSurface> surface = {};

  bool has_share() const { return share != nullptr || surface.has_value(); }
  // The share of the stated waters that the table does not have; 0 where that is less than is worth a word.
  double beyond_table() const;
};

// InvalidArgument with what would be right: a state without one of its two numbers or missing for `processed_with`,
// photons without a bias treatment.
absl::Status CheckWater(const KnownWater& water);

// `table` must not be null if the water has a bias treatment; half a second of one core. InvalidArgument with what
// would be right: as CheckWater, optics that contradict each other, what the table does not cover
// (water_contribution.h), a centroid that is to locate the surface.
absl::StatusOr<CompiledWater> CompileWater(const WaterColumnTable* table, const KnownWater& water);

// Where each pulse's own return located the surface, a green laser finds it as much lower as chance has it: adds this
// to the error of the surface's range. Elsewhere the mean over many pulses has averaged it out.
void AddGreenSpread(const GreenSurface& surface, SurfaceLocation located, AirErrors& errors);

// What was assumed where the description has no value: one sentence each, for people.
std::vector<std::string> AssumptionsOf(const KnownWater& water, const CompiledWater& compiled);

}  // namespace albtpu
