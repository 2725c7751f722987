#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "generator/campaign/campaign.h"
#include "generator/commands/commands.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "sea/angle.h"
#include "sea/wave_state.h"

namespace albtpu {
namespace {

// At least so many realizations make the standard error of a variance reliable; at most so many are computed even if
// the relative error is not reached.
constexpr int kLeastRealizations = 1000, kMostRealizations = 40'000;

SeaCase SeaCaseAt(const PointOptions& options) {
  SeaCase sea_case;
  sea_case.sea = {.waves = WindSea{.wind_speed_10m = options.wind_speed,
                                   .fetch = options.fetch,
                                   .model = FindSpectrumModel(options.spectrum)},
                  .corrected_above = options.corrected_above};
  sea_case.refractive_index = options.refractive_index;
  sea_case.depths = options.depth;
  const std::vector<double> azimuths =
      options.azimuth ? std::vector<double>{*options.azimuth} : std::vector<double>{0, 90};
  for (const double azimuth : azimuths) {
    sea_case.beams.push_back({.incidence = RadiansOfDegrees(options.incidence),
                              .azimuth = RadiansOfDegrees(azimuth),
                              .footprint = options.footprint,
                              .profile = *FindBeamProfile(options.profile)});
  }
  return sea_case;
}

// Each value is the larger in magnitude of two beams, as tables answer for an unknown azimuth.
BeamUncertainty WorseOf(BeamUncertainty a, const BeamUncertainty& b) {
  const auto take = [](Estimate& ours, const Estimate& other) {
    if (std::abs(other.value) > std::abs(ours.value)) ours = other;
  };
  take(a.refraction_along_wind, b.refraction_along_wind);
  take(a.refraction_cross_wind, b.refraction_cross_wind);
  for (std::size_t d = 0; d < a.thu.size(); ++d) {
    take(a.thu[d], b.thu[d]);
    take(a.tvu[d], b.tvu[d]);
    take(a.bias_along_beam[d], b.bias_along_beam[d]);
    take(a.bias_vertical[d], b.bias_vertical[d]);
  }
  return a;
}

void AddToJson(nlohmann::ordered_json& json, const std::string& name,
               const std::vector<Estimate>& estimates) {
  std::vector<double> values, standard_errors;
  for (const Estimate& estimate : estimates) {
    values.push_back(estimate.value);
    standard_errors.push_back(estimate.standard_error);
  }
  json[name] = values;
  json[name + "_standard_error"] = standard_errors;
}

void PrintJson(const PointOptions& options, const SeaCaseResult& result, double seconds) {
  const BeamUncertainty beam = WorseOf(result.beams.front(), result.beams.back());
  nlohmann::ordered_json json;
  const auto add_angle = [&](const std::string& name, const Estimate& estimate) {
    json[name] = DegreesOfRadians(estimate.value);
    json[name + "_standard_error"] = DegreesOfRadians(estimate.standard_error);
  };
  add_angle("refraction_along_wind", beam.refraction_along_wind);
  add_angle("refraction_cross_wind", beam.refraction_cross_wind);
  json["depth"] = options.depth;
  AddToJson(json, "thu", beam.thu);
  AddToJson(json, "tvu", beam.tvu);
  AddToJson(json, "bias_along_beam", beam.bias_along_beam);
  AddToJson(json, "bias_vertical", beam.bias_vertical);
  json["azimuth_absent"] = !options.azimuth.has_value();
  json["realizations"] = result.realizations;
  json["seconds"] = seconds;
  std::cout << json.dump() << '\n';
}

void PrintText(const PointOptions& options, const SeaCaseResult& result) {
  const BeamUncertainty beam = WorseOf(result.beams.front(), result.beams.back());
  const auto angle = [](const char* name, const Estimate& estimate) {
    std::printf("%-22s %8.4f +- %.4f degree\n", name, DegreesOfRadians(estimate.value),
                DegreesOfRadians(estimate.standard_error));
  };
  if (!options.azimuth)
    std::printf("azimuth not given: each value is the larger of those at 0 and 90 degrees\n");
  std::printf("2 sigma, sea surface only; +- is one standard error of %d realizations\n",
              result.realizations);
  angle("refraction along wind", beam.refraction_along_wind);
  angle("refraction cross wind", beam.refraction_cross_wind);
  std::printf("\n%8s  %-19s %-19s %-21s %-21s\n", "depth m", "THU m", "TVU m", "bias along beam m",
              "bias vertical m");
  for (std::size_t d = 0; d < options.depth.size(); ++d) {
    std::printf("%8g  %8.4f +- %-7.4f %8.4f +- %-7.4f %9.4f +- %-8.4f %9.4f +- %-8.4f\n", options.depth[d],
                beam.thu[d].value, beam.thu[d].standard_error, beam.tvu[d].value, beam.tvu[d].standard_error,
                beam.bias_along_beam[d].value, beam.bias_along_beam[d].standard_error,
                beam.bias_vertical[d].value, beam.bias_vertical[d].standard_error);
  }
}

}  // namespace

absl::Status RunPoint(const PointOptions& options) {
  const Effort effort{.realizations = kLeastRealizations,
                      .most_realizations = kMostRealizations,
                      .relative_error = options.relative_error,
                      .estimator = *FindEstimator(options.estimator)};
  const auto start = std::chrono::steady_clock::now();
  const SeaCaseResult result = Simulate(SeaCaseAt(options), effort, options.seed, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!result.converged) {
    std::fprintf(
        stderr,
        "albtpu-generate: not all values reached a relative error of %g (after %d realizations); their "
        "standard errors are printed beside them\n",
        options.relative_error, result.realizations);
  }
  if (options.json) {
    PrintJson(options, result, seconds);
  } else {
    PrintText(options, result);
  }
  return absl::OkStatus();
}

}  // namespace albtpu
