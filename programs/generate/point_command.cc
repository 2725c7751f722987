#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "programs/generate/commands.h"
#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/sampled_spectrum.h"
#include "sea/sea_state.h"
#include "sea/sea_time.h"
#include "sea/spectra/described_sea.h"
#include "sea/table/sea_attributes.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

struct TracedSea {
  DescribedSea described;
  KnownWaves waves;  // in the frame of `described`
};

absl::Status Problem(const SeaOfFile& given, std::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(given.file.string(), ": ", std::string(what)));
}

// The state of the file at the given time, or its only one.
absl::StatusOr<const SeaRecord*> FindRecord(const SeaOfFile& given, const SeaSeries& series) {
  if (series.points.size() > 1)
    return Problem(given, absl::StrCat("has ", series.points.size(), " places; give a file of one of them"));
  const std::vector<SeaRecord>& records = series.records;
  if (!given.time) {
    if (records.size() == 1) return &records.front();
    return Problem(given, absl::StrCat("has ", records.size(), " states of the sea; choose one by its time, such as ",
                                       records.front().time ? SeaTimeText(*records.front().time) : "its first"));
  }
  const std::optional<double> time = ParseSeaTime(*given.time);
  if (!time) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", *given.time, "' is not a time of a sea; give UTC, such as 2020-06-08T03:50Z"));
  }
  const SeaRecord* nearest = nullptr;
  for (const SeaRecord& record : records) {
    if (!record.time) continue;
    if (nearest == nullptr || std::abs(*record.time - *time) < std::abs(*nearest->time - *time)) nearest = &record;
  }
  if (nearest == nullptr) return Problem(given, "does not say when its sea was; leave out the time");
  if (*nearest->time != *time) {
    return Problem(
        given, absl::StrCat("has no sea at ", *given.time, "; the nearest is that of ", SeaTimeText(*nearest->time)));
  }
  return nearest;
}

SeaDescription DescriptionOf(const SeaOfFile& given) {
  SeaDescription description;
  description.wind_speed_10m = given.wind_speed;
  if (given.wind_from) description.wind_from = RadiansOfDegrees(*given.wind_from);
  description.water_depth = given.water_depth;
  description.tail = given.tail;
  description.tail_from = given.tail_from;
  return description;
}

// NotFound or InvalidArgument, beginning with the path: the file cannot be read, has several places, or has no state of
// this time.
absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(given.file, error))
    return absl::NotFoundError(absl::StrCat(given.file.string(), ": no such file of a sea"));
  const absl::StatusOr<SeaSeries> series = ReadSeaFile(given.file);
  if (!series.ok()) return Problem(given, std::string(series.status().message()));
  ASSIGN_OR_RETURN(const SeaRecord* record, FindRecord(given, *series));

  TracedSea sea;
  sea.described = Describe(*record, DescriptionOf(given));
  sea.waves.spectrum = std::make_shared<SampledSpectrum>(
      sea.described.spectrum, SpectrumText{.name = series->format, .reference = "none", .departures = "none"});
  return sea;
}

// The minimum number of realizations for a reliable standard error of a variance, and the maximum number, which is
// computed even if the relative error is not reached.
constexpr int kMinRealizations = 1000, kMaxRealizations = 40'000;

// The azimuths [degree, from the x axis] of the beams of which the worst is taken if none is given.
std::vector<double> Azimuths(const PointOptions& options, const std::optional<TracedSea>& sea) {
  if (options.azimuth) return {*options.azimuth};
  if (options.beam_azimuth) return {BeamAzimuth(*options.beam_azimuth, DegreesOfRadians(sea->described.x_azimuth))};
  if (sea) return {0, 30, 60, 90, 120, 150};
  return {0, 90};
}

SeaCase SeaCaseAt(const PointOptions& options, const std::optional<TracedSea>& sea) {
  SeaCase sea_case;
  sea_case.sea.corrected_above = options.corrected_above;
  if (sea) {
    sea_case.sea.waves = sea->waves;
  } else {
    sea_case.sea.waves = WindSea{
        .wind_speed_10m = options.wind_speed, .fetch = options.fetch, .model = FindSpectrumModel(options.spectrum)};
  }
  sea_case.refractive_index = options.refractive_index;
  sea_case.depths = options.depth;
  for (const double azimuth : Azimuths(options, sea)) {
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

BeamUncertainty WorstOf(const std::vector<BeamUncertainty>& beams) {
  return std::accumulate(beams.begin() + 1, beams.end(), beams.front(), WorseOf);
}

bool KnowsAzimuth(const PointOptions& options) { return options.azimuth || options.beam_azimuth; }

void AddToJson(nlohmann::ordered_json& json, const std::string& name, const std::vector<Estimate>& estimates) {
  std::vector<double> values, standard_errors;
  for (const Estimate& estimate : estimates) {
    values.push_back(estimate.value);
    standard_errors.push_back(estimate.standard_error);
  }
  json[name] = values;
  json[name + "_standard_error"] = standard_errors;
}

void PrintJson(const PointOptions& options, const std::optional<TracedSea>& sea, const SeaCaseResult& result,
               double seconds) {
  const BeamUncertainty beam = WorstOf(result.beams);
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
  json["azimuth_absent"] = !KnowsAzimuth(options);
  if (sea) json["x_azimuth"] = DegreesOfRadians(sea->described.x_azimuth);
  json["realizations"] = result.realizations;
  json["seconds"] = seconds;
  std::cout << json.dump() << '\n';
}

void PrintText(const PointOptions& options, const std::optional<TracedSea>& sea, const SeaCaseResult& result) {
  const BeamUncertainty beam = WorstOf(result.beams);
  const auto angle = [](const char* name, const Estimate& estimate) {
    std::printf("%-22s %8.4f +- %.4f degree\n", name, DegreesOfRadians(estimate.value),
                DegreesOfRadians(estimate.standard_error));
  };
  if (sea) {
    std::printf("the x axis (\"along wind\") points to %.1f degrees of the compass\n",
                DegreesOfRadians(sea->described.x_azimuth));
  }
  if (!KnowsAzimuth(options)) {
    std::printf("azimuth not given: each value is the %s degrees\n",
                sea ? "largest of those at 0, 30, ..., 150" : "larger of those at 0 and 90");
  }
  if (result.realizations == 0)
    std::printf("2 sigma, sea surface only; there are no waves, all values are exact\n");
  else
    std::printf("2 sigma, sea surface only; +- is one standard error of %d realizations\n", result.realizations);
  angle("refraction along wind", beam.refraction_along_wind);
  angle("refraction cross wind", beam.refraction_cross_wind);
  std::printf("\n%8s  %-19s %-19s %-21s %-21s\n", "depth m", "THU m", "TVU m", "bias along beam m", "bias vertical m");
  for (std::size_t d = 0; d < options.depth.size(); ++d) {
    std::printf("%8g  %8.4f +- %-7.4f %8.4f +- %-7.4f %9.4f +- %-8.4f %9.4f +- %-8.4f\n", options.depth[d],
                beam.thu[d].value, beam.thu[d].standard_error, beam.tvu[d].value, beam.tvu[d].standard_error,
                beam.bias_along_beam[d].value, beam.bias_along_beam[d].standard_error, beam.bias_vertical[d].value,
                beam.bias_vertical[d].standard_error);
  }
}

}  // namespace

absl::Status RunPoint(const PointOptions& options) {
  const Effort effort{.realizations = kMinRealizations,
                      .most_realizations = kMaxRealizations,
                      .relative_error = options.relative_error,
                      .estimator = *FindEstimator(options.estimator)};
  std::optional<TracedSea> sea;
  if (options.sea) {
    ASSIGN_OR_RETURN(sea, ReadTracedSea(*options.sea));
    for (const std::string& sentence : Sentences(sea->described.assumed))
      std::cerr << "albtpu-generate: " << sentence << '\n';
  }
  const auto start = std::chrono::steady_clock::now();
  const SeaCase sea_case = SeaCaseAt(options, sea);
  RETURN_IF_ERROR(CheckTraceable(sea_case));
  const SeaCaseResult result = Simulate(sea_case, effort, options.seed, 0);
  if (!std::all_of(result.beams.begin(), result.beams.end(), IsFinite)) {
    return absl::InternalError(
        "values are not finite (rays met waves from behind); give a smaller incidence or a weaker wind");
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!result.converged) {
    std::fprintf(stderr,
                 "albtpu-generate: not all values reached a relative error of %g (after %d realizations); their "
                 "standard errors are printed beside them\n",
                 options.relative_error, result.realizations);
  }
  if (options.json)
    PrintJson(options, sea, result, seconds);
  else
    PrintText(options, sea, result);
  return absl::OkStatus();
}

}  // namespace albtpu::programs
