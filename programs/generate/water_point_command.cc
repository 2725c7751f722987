#include <array>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "generator/water/water_column.h"
#include "programs/generate/commands.h"
#include "sea/angle.h"
#include "tables/water/water_schema.h"

namespace albtpu::programs {
namespace {

// Standard errors come from the scatter of this many pools of photons.
constexpr std::uint32_t kPools = 8;
// Relative standard error of the energy beyond which an echo has too few pairs.
constexpr double kMaxRelative = 0.05;

Estimate InMetres(const Estimate& relative, double depth) {
  return {relative.value * depth, relative.standard_error * depth};
}

void PrintJson(const WaterColumnBias& bias, double depth) {
  nlohmann::ordered_json json;
  const auto add = [&json](const std::string& name, const Estimate& estimate) {
    json[name] = estimate.value;
    json[name + "_standard_error"] = estimate.standard_error;
  };
  const DetectedBias& detected = *bias.by_pulse.front();
  for (const Detector detector : kDetectors) {
    const std::string name(kDetectorNames[Index(detector)]);
    add("bias_vertical_" + name, InMetres(detected.vertical[Index(detector)], depth));
  }
  for (const Detector detector : kDetectors) {
    const std::string name(kDetectorNames[Index(detector)]);
    add("bias_along_beam_" + name, InMetres(detected.along[Index(detector)], depth));
  }
  add("spot", InMetres(bias.spot, depth));
  add("stretch", detected.stretch);
  add("energy", bias.energy);
  std::cout << json.dump() << '\n';
}

void PrintText(const WaterColumnBias& bias, const WaterPointOptions& options) {
  const DetectedBias& detected = *bias.by_pulse.front();
  std::printf("reported minus true; +- is one standard error of %u photons\n", options.photons);
  std::printf("%-10s %-25s %-25s\n", "detector", "bias vertical m", "bias along beam m");
  for (const Detector detector : kDetectors) {
    const Estimate vertical = InMetres(detected.vertical[Index(detector)], options.depth);
    const Estimate along = InMetres(detected.along[Index(detector)], options.depth);
    std::printf("%-10s %9.4f +- %-12.4f %9.4f +- %-.4f\n", kDetectorNames[Index(detector)].data(),
                vertical.value, vertical.standard_error, along.value, along.standard_error);
  }
  const Estimate spot = InMetres(bias.spot, options.depth);
  std::printf("spot on the bottom, 1 sigma   %.3f +- %.3f m (resolution, not uncertainty)\n", spot.value,
              spot.standard_error);
  std::printf("echo's width over the pulse's %.3f +- %.3f\n", detected.stretch.value,
              detected.stretch.standard_error);
  std::printf("energy in the field of view   %.4f +- %.4f of unscattered light's\n", bias.energy.value,
              bias.energy.standard_error);
}

}  // namespace

absl::Status RunWaterPoint(const WaterPointOptions& options) {
  const double depth = options.depth;
  const WaterColumn column{.incidence = RadiansOfDegrees(options.incidence),
                           .refractive_index = options.refractive_index,
                           .group_index = options.group_index,
                           .scattering = options.scattering * depth,
                           .absorption = options.absorption / options.scattering,
                           .field_of_view = options.field_of_view / depth,
                           .footprint = options.footprint / depth};
  const std::array pulse_lengths = {PulseLengthOverDepth(options.pulse_length, depth, options.group_index)};
  const WaterColumnBias bias =
      ComputeWaterColumn(PhaseFunction::FournierForand(options.backscatter_fraction), column, pulse_lengths,
                         {.photons = options.photons / kPools, .pools = kPools, .seed = options.seed});
  if (!bias.by_pulse.front().has_value() || bias.energy.standard_error > kMaxRelative * bias.energy.value) {
    return absl::FailedPreconditionError(absl::StrCat(
        "no echo comes back from ", depth, " m that is significant with these photons (the water scatters ",
        column.scattering, " times on the way down); give a smaller depth, clearer water or more photons"));
  }
  options.json ? PrintJson(bias, depth) : PrintText(bias, options);
  return absl::OkStatus();
}

}  // namespace albtpu::programs
