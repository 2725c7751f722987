#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "generator/water/photon_walk.h"
#include "generator/water/water_column.h"
#include "sea/angle.h"
#include "tables/water/water_schema.h"
#include "validation/studies/studies.h"
#include "validation/studies/water_round_trip.h"

namespace albtpu {
namespace {

constexpr double kGroupIndex = 1.36;

// Petzold's mean ocean particle.
const PhaseFunction& Ocean() {
  static const PhaseFunction ocean = PhaseFunction::FournierForand(kMeanBackscatterFraction);
  return ocean;
}

struct LidarSystem {
  std::string name;
  double field_of_view, nanoseconds, footprint;  // m, ns, m
};
const LidarSystem kNarrow{"narrow", 3, 1.5, 0.5}, kWide{"wide", 16, 5, 2};

// Water of albedo 0.8 whose diffuse attenuation is this [1/m], by Kirk's formula (tables/water/water_schema.h).
constexpr double kKirk = 0.256;
struct Water {
  double absorption, scattering;
};
Water OfAttenuation(double attenuation) {
  const double absorption = attenuation / std::sqrt(1 + kKirk * 4);
  return {absorption, 4 * absorption};
}

WaterColumn ColumnOf(const LidarSystem& lidar, const Water& water, double incidence, double depth) {
  return {.incidence = RadiansOfDegrees(incidence),
          .refractive_index = kSeaWaterIndex,
          .group_index = kGroupIndex,
          .scattering = water.scattering * depth,
          .absorption = water.absorption / water.scattering,
          .field_of_view = lidar.field_of_view / depth,
          .footprint = lidar.footprint / depth};
}

double PulseLength(const LidarSystem& lidar, double depth) {
  return PulseLengthOverDepth(lidar.nanoseconds, depth, kGroupIndex);
}

// The rounded results of an independent program with the same definitions: too deep by peak and half [cm], and the spot
// [m].
struct Found {
  const LidarSystem& lidar;
  double attenuation, depth, peak, half, spot, peak_rounding, half_rounding;
};

std::vector<Found> FoundApart() {
  return {{kNarrow, 0.1, 5, 1.4, 0.6, 0.33, 0.05, 0.05},   {kNarrow, 0.1, 10, 2.4, 0.4, 0.54, 0.05, 0.05},
          {kNarrow, 0.1, 20, 3.8, -0.9, 1.31, 0.05, 0.05}, {kNarrow, 0.2, 5, 2.9, 1.2, 0.43, 0.05, 0.05},
          {kNarrow, 0.2, 10, 5.1, 1.2, 0.83, 0.05, 0.05},  {kNarrow, 0.2, 20, 13.5, 1, 2.35, 0.3, 0.5},
          {kWide, 0.1, 5, 4.3, 2.8, 0.91, 0.05, 0.05},     {kWide, 0.1, 10, 9.9, 5.6, 1.57, 0.05, 0.05},
          {kWide, 0.1, 20, 23, 8.7, 2.70, 0.5, 0.05},      {kWide, 0.2, 5, 8.5, 5.6, 1.11, 0.05, 0.05},
          {kWide, 0.2, 10, 20.4, 11.5, 1.96, 0.05, 0.05},  {kWide, 0.2, 20, 53.3, 23, 3.36, 0.05, 0.5}};
}

Comparison Compared(std::string quantity, std::string unit, double published, const Estimate& ours, double allowed,
                    std::string basis) {
  return {.quantity = std::move(quantity),
          .unit = std::move(unit),
          .published = published,
          .ours = ours.value,
          .standard_error = ours.standard_error > 0 ? ours.standard_error : kNoNumber,
          .verdict = AgreesIf(std::abs(ours.value - published) <= allowed),
          .basis = std::move(basis)};
}

void AddMoments(Study& study) {
  const std::string basis = "within 2e-5; integrated apart from this code, with the light below 1e-6 rad";
  study.comparisons.push_back(
      Compared("Fournier-Forand 0.0183: mean cosine", "", 0.930004, {Ocean().MeanCosine(), 0}, 2e-5, basis));
  study.comparisons.push_back(
      Compared("Fournier-Forand 0.0183: mean of P2", "", 0.877219, {Ocean().MeanSecondLegendre(), 0}, 2e-5, basis));
  study.comparisons.push_back(Compared("Fournier-Forand 0.0183: mean square angle", "rad2", 0.176922,
                                       {Ocean().MeanSquareAngle(), 0}, 2e-5, basis));
}

// The mean weight of `photons`, of which those that arrive have an excess of path, and the others no weight.
template <typename Weight>
Estimate MeanOver(const std::vector<float>& excesses, std::uint32_t photons, const Weight& weight_of) {
  double sum = 0, squares = 0;
  for (const float excess : excesses) {
    const double weight = weight_of(excess);
    sum += weight;
    squares += weight * weight;
  }
  const double mean = sum / photons;
  return {mean, std::sqrt((squares / photons - mean * mean) / photons)};
}

void AddSlab(const StudyOptions& options, Study& study) {
  const double depths[] = {1.8};
  const std::uint32_t photons = options.quick ? 50'000 : 2'000'000;
  const auto slab =
      WalkPhotons(PhaseFunction::HenyeyGreenstein(0.75), {.refractive_index = 1}, depths, photons, options.seed, 0, 0);
  const Estimate energy =
      MeanOver(slab[0].excess, photons, [&](float excess) { return std::exp(-(double{excess} + depths[0]) / 9); });
  study.comparisons.push_back(Compared("light through a slab: optical depth 2, albedo 0.9, Henyey-Greenstein 0.75", "",
                                       0.66096, energy, 4 * energy.standard_error,
                                       "within 4 standard errors of van de Hulst (1980)"));
}

// Energy after small angles with absorption: sech(1) at sqrt(a D) z = 1.
void AddSmallAngles(const StudyOptions& options, Study& study) {
  const double sigma = 0.002, depths[] = {200};
  const PhaseFunction gaussian([sigma](double psi) { return -std::expm1(-psi * psi / (2 * sigma * sigma)); });
  const std::uint32_t photons = options.quick ? 8'000 : 300'000;
  const auto planes = WalkPhotons(gaussian, {}, depths, photons, options.seed, 1, 0);
  const double absorption = 1 / std::pow(depths[0] * sigma, 2);
  const Estimate energy =
      MeanOver(planes[0].excess, photons, [&](float excess) { return std::exp(-absorption * excess); });
  study.comparisons.push_back(Compared("energy after many small angles with absorption", "", 1 / std::cosh(1.0), energy,
                                       0.001 + 4 * energy.standard_error,
                                       "within 0.001 and 4 standard errors of sech(1): exact for small angles"));
}

void AddRoundTrips(const StudyOptions& options, Study& study) {
  const Water water = OfAttenuation(0.1);
  const double depth = 10, incidence = 12;
  const WaterColumn column = ColumnOf(kWide, water, incidence, depth);
  const std::array pulses = {PulseLength(kWide, depth)};
  const RoundTrip trip{.incidence = column.incidence,
                       .refractive_index = kSeaWaterIndex,
                       .group_index = kGroupIndex,
                       .scattering = water.scattering,
                       .absorption = water.absorption,
                       .depth = depth,
                       .field_of_view = kWide.field_of_view,
                       .footprint = kWide.footprint};
  const WaterColumnBias trips =
      BiasOfEchoes(TraceRoundTrips(Ocean(), trip, pulses[0] / 30, 16, options.quick ? 25'000 : 1'000'000, options.seed),
                   column, pulses);
  const WalkSetup beam{.refracted = RefractedAngle(column.incidence, kSeaWaterIndex),
                       .longest_excess = 14 / column.absorption};
  WalkSetup receiver = beam;
  receiver.cone = trip.cone;
  const EchoSetup setup{.incidence = column.incidence,
                        .refracted = beam.refracted,
                        .group_index = kGroupIndex,
                        .absorption = column.absorption,
                        .footprint = column.footprint,
                        .field_of_view = column.field_of_view,
                        .step = pulses[0] / 30,
                        .pairs_per_photon = 5};
  const double depths[] = {column.scattering};
  std::vector<Echo> pools;
  for (std::uint32_t pool = 0; pool < 8; ++pool) {
    const auto down = WalkPhotons(Ocean(), beam, depths, 100'000, options.seed, 2, pool);
    const auto up = WalkPhotons(Ocean(), receiver, depths, 100'000, options.seed, 3, pool);
    pools.push_back(PairPhotons(down[0], up[0], setup, options.seed, 2, pool));
  }
  const WaterColumnBias pairs = BiasOfEchoes(pools, column, pulses);
  if (!trips.by_pulse[0] || !pairs.by_pulse[0]) return;
  for (const Detector detector : kDetectors) {
    const Estimate &whole = trips.by_pulse[0]->vertical[Index(detector)],
                   &ours = pairs.by_pulse[0]->vertical[Index(detector)];
    const double error = depth * std::hypot(whole.standard_error, ours.standard_error);
    study.comparisons.push_back(Compared(
        absl::StrCat("vertical bias by ", std::string(kDetectorNames[Index(detector)]),
                     ", whole round trips beside pairs of photons"),
        "m", depth * whole.value, {depth * ours.value, depth * ours.standard_error}, std::max(0.001, 3 * error),
        "within 1 mm or 3 standard errors of both: light finds its way back as it would have come"));
  }
}

void AddSystems(const StudyOptions& options, Study& study) {
  DataTable table{.name = "water_column",
                  .title = "Bottom reported too deep at 12 degrees, by detector, and the shift along the beam",
                  .columns = {"system", "attenuation_per_m", "depth_m", "peak_cm", "peak_error_cm",
                              "peak_found_apart_cm", "half_cm", "half_error_cm", "half_found_apart_cm", "centroid_cm",
                              "peak_along_cm", "half_along_cm", "spot_m", "spot_found_apart_m", "energy"}};
  const WaterEffort effort{.photons = options.quick ? 10'000u : 200'000u, .seed = options.seed, .cell = 4};
  for (const Found& found : FoundApart()) {
    const WaterColumn column = ColumnOf(found.lidar, OfAttenuation(found.attenuation), 12, found.depth);
    const std::array pulses = {PulseLength(found.lidar, found.depth)};
    const WaterColumnBias bias = ComputeWaterColumn(Ocean(), column, pulses, effort);
    if (!bias.by_pulse[0]) continue;
    const DetectedBias& detected = *bias.by_pulse[0];
    const double cm = 100 * found.depth;
    const auto deep = [&](Detector detector) {
      const Estimate& vertical = detected.vertical[Index(detector)];
      return Estimate{-cm * vertical.value, cm * vertical.standard_error};
    };
    const Estimate peak = deep(Detector::kPeak), half = deep(Detector::kHalf);
    table.Add(found.lidar.name, found.attenuation, found.depth, peak, found.peak, half, found.half,
              deep(Detector::kCentroid).value, cm * detected.along[Index(Detector::kPeak)].value,
              cm * detected.along[Index(Detector::kHalf)].value, found.depth * bias.spot.value, found.spot,
              bias.energy.value);
    const std::string where = absl::StrCat(found.lidar.name, ", ", found.attenuation, " 1/m, ", found.depth, " m");
    const std::string basis = "within 0.2 cm, its rounding and 3 standard errors of a program apart from this one";
    study.comparisons.push_back(Compared(absl::StrCat("too deep by the peak: ", where), "cm", found.peak, peak,
                                         0.2 + found.peak_rounding + 3 * peak.standard_error, basis));
    study.comparisons.push_back(Compared(absl::StrCat("too deep at half height: ", where), "cm", found.half, half,
                                         0.2 + found.half_rounding + 3 * half.standard_error, basis));
  }
  study.tables.push_back(std::move(table));
}

}  // namespace

absl::StatusOr<Study> WaterColumnStudy(const StudyOptions& options) {
  Study study;
  study.id = "water_column";
  study.title = "The water column: the bias of a detector by scattering";
  study.paragraphs = {
      "Below the surface light scatters. The spread of the photons is resolution; what concerns a reported "
      "point is the shift of its detector against the same beam in clear water. A Monte Carlo walks photons "
      "down and pairs them with photons that the receiver sends out, because light finds its way back as it "
      "would have come. docs/physics.md, section 8, has its equations.",
      "The parts are compared with what is known apart from them, and the pairs with photons that make the "
      "whole way down, off the bottom and up again. The last comparisons are with another program for the "
      "same definitions: a narrow system (field of view 3 m, pulse 1.5 ns, footprint 0.5 m) and a wide one "
      "(16 m, 5 ns, 2 m), albedo 0.8, Petzold's mean phase function.",
      "The vendor's detector, the albedo and the phase function of the water are hardly known in a survey. "
      "The bias differs so much between systems in one water that it cannot be left to a default."};
  AddMoments(study);
  AddSlab(options, study);
  AddSmallAngles(options, study);
  AddRoundTrips(options, study);
  AddSystems(options, study);
  return study;
}

}  // namespace albtpu
