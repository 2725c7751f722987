#include "budget/water/known_water.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace albtpu {

absl::Status CheckWater(const KnownWater& water) {
  if (water.photons.has_value() && !water.bias.has_value()) {
    return absl::InvalidArgumentError(
        "photons have no effect without a bias treatment (their noise is part of the share that is left out); leave "
        "them out, or give a treatment");
  }
  if (water.temperature.has_value() != water.salinity.has_value())
    return absl::InvalidArgumentError("temperature and salinity go together (the index follows from both); give both");
  if (!water.processed_with.has_value() || water.index().has_value()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      "processed_with needs the index that the water has; give its temperature (degree C) and salinity");
}

double CompiledWater::beyond_table() const {
  constexpr double kLeast = 0.005;
  return share != nullptr && share->beyond_table() >= kLeast ? share->beyond_table() : 0;
}

std::optional<WaterIndex> KnownWater::index() const {
  if (!temperature.has_value() || !salinity.has_value()) return std::nullopt;
  return SeaWaterIndex(*temperature, *salinity);
}

absl::StatusOr<CompiledWater> CompileWater(const WaterColumnTable* table, const KnownWater& water) {
  if (absl::Status status = CheckWater(water); !status.ok()) return status;
  CompiledWater compiled{.photons = water.photons};
  if (water.processed_with.has_value()) {
    compiled.of_water = water.index();
    compiled.processed_with = *water.processed_with;
  }
  if (!water.bias.has_value() && !water.green_surface) return compiled;
  absl::StatusOr<WaterOptics> optics = OpticsOf(water.optics);
  if (!optics.ok()) return optics.status();
  compiled.optics = *optics;
  if (water.bias.has_value()) {
    assert(table != nullptr);
    const std::optional<WaterIndex> index = water.index();
    const WaterReceiver receiver{.detector = water.detector,
                                 .field_of_view = water.field_of_view,
                                 .pulse_length = water.pulse_length,
                                 .group_index = index.has_value() ? index->group : kSeaWaterGroupIndex};
    absl::StatusOr<WaterContribution> share = WaterContribution::Create(*table, *optics, receiver, *water.bias);
    if (!share.ok()) return share.status();
    compiled.share = std::make_shared<const WaterContribution>(*std::move(share));
  }
  if (!water.green_surface) return compiled;
  if (water.detector == EchoDetector::kCentroid) {
    return absl::InvalidArgumentError(
        "a green surface cannot be computed for the detector \"centroid\" (the water's light has no end that would "
        "give a centroid); give \"half\" or \"peak\", or leave it out where the processing corrected it");
  }
  compiled.surface = GreenSurfaceOf(*optics, {.detector = water.detector, .pulse_length = water.pulse_length});
  return compiled;
}

void AddGreenSpread(const GreenSurface& surface, SurfaceLocation located, AirErrors& errors) {
  if (located != SurfaceLocation::kPulse) return;
  errors.surface_range = std::hypot(errors.surface_range, surface.spread);
}

std::vector<std::string> AssumptionsOf(const KnownWater& water, const CompiledWater& compiled) {
  std::vector<std::string> sentences;
  if (compiled.optics.has_value()) {
    const WaterOptics& optics = *compiled.optics;
    if (!water.optics.kd_sigma.has_value()) {
      sentences.push_back(
          absl::StrFormat("The attenuation is known to %.3g %% (1 sigma), which is what %s is good for.",
                          100 * optics.attenuation_log_sigma, TextOf(water.optics).way));
    }
    const double ratio = optics.scattering_over_absorption, albedo = ratio / (1 + ratio);
    if (!water.optics.omega0.has_value() && !water.optics.absorption.has_value()) {
      sentences.push_back(absl::StrFormat("The single-scattering albedo is %.3g, as that of coastal water.", albedo));
      if (optics.limited_by_pure_water())
        sentences.push_back(
            absl::StrFormat("At the attenuation that is given, the albedo is at most %.3g: no water absorbs less than "
                            "pure water.",
                            optics.typical_albedo()));
    }
    if (!water.optics.omega0_sigma.has_value() && !water.optics.absorption.has_value())
      sentences.push_back("The albedo is known to 0.1 (1 sigma).");
    if (const double beyond = compiled.beyond_table(); beyond > 0)
      sentences.push_back(absl::StrFormat(
          "The albedo is no larger than in the table of the water column: %.2g %% of the waters that were stated lie "
          "beyond, and are left out.",
          100 * beyond));
    if (!water.optics.backscatter_fraction.has_value()) {
      sentences.push_back(absl::StrCat("The backscatter fraction is between ", optics.least_fraction, " and ",
                                       optics.most_fraction, ", as that of natural particles."));
    }
  }
  if (water.bias.has_value() && !water.index().has_value())
    sentences.push_back(absl::StrCat("The group index of the water is that of sea water, ", kSeaWaterGroupIndex, "."));
  if (!water.processed_with.has_value())
    sentences.push_back("The ranges in water were computed with the group index of the water.");
  if (water.bias.has_value() && !water.photons.has_value())
    sentences.push_back("The noise of the photons of an echo is in the error of the range to the bottom.");
  return sentences;
}

}  // namespace albtpu
