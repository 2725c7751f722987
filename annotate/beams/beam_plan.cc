#include "annotate/beams/beam_plan.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "formats/text/number_text.h"

namespace albtpu::annotate {

using nlohmann::ordered_json;

namespace {

ordered_json NameAndSize(const std::filesystem::path& path) {
  std::error_code unknown;
  return {{"name", path.filename().string()}, {"bytes", std::filesystem::file_size(path, unknown)}};
}

template <typename Files>
ordered_json NamesAndSizes(const Files& files) {
  ordered_json json = ordered_json::array();
  for (const auto& file : files) json.push_back(NameAndSize(file->name()));
  return json;
}

}  // namespace

bool BeamPlan::has_direction() const {
  if (const auto* scan = std::get_if<AcrossTrackScan>(&source)) return scan->flight_direction.has_value();
  if (const auto* constant = std::get_if<ConstantIncidence>(&source))
    return constant->beam_azimuth.has_value();
  return true;
}

std::vector<std::string> FilesOf(const BeamPlan& plan) {
  std::vector<std::string> files;
  if (plan.trajectories != nullptr) {
    for (const auto& trajectory : *plan.trajectories) files.push_back(trajectory->name());
  }
  for (const auto& errors : plan.trajectory_errors) files.push_back(errors->name());
  if (plan.water_level_file.has_value()) files.push_back(*plan.water_level_file);
  return files;
}

ordered_json Parameters(const BeamPlan& plan) {
  const auto or_null = [](const auto& value) {
    return value.has_value() ? ordered_json(*value) : ordered_json();
  };
  ordered_json json = {{"incidence_from", kIncidenceSources[plan.source.index()]}};
  if (const auto* constant = std::get_if<ConstantIncidence>(&plan.source)) {
    json["incidence"] = constant->incidence;
    json["beam_azimuth"] = or_null(constant->beam_azimuth);
    json["altitude"] = or_null(constant->altitude);
  } else if (const auto* scan = std::get_if<AcrossTrackScan>(&plan.source)) {
    json["flight_direction"] = or_null(scan->flight_direction);
    json["altitude"] = or_null(scan->altitude);
  } else if (const auto* files = std::get_if<TrajectoryFromFiles>(&plan.source)) {
    json["trajectory"] = plan.trajectories != nullptr ? NamesAndSizes(*plan.trajectories) : ordered_json();
    json["trajectory_errors"] = NamesAndSizes(plan.trajectory_errors);
    json["trajectory_time"] = files->utc ? "utc" : "gps";
    json["geoid_separation"] = or_null(files->geoid_separation);
    json["lever_arm"] = files->lever_arm;
    json["crs"] = or_null(files->crs);
  } else {
    json["crs"] = or_null(std::get<TrajectoryFromReturns>(plan.source).crs);
  }
  json["water_index"] = plan.has_track() ? ordered_json(plan.refractive_index) : ordered_json();
  json["water_level"] = or_null(plan.water_level);
  json["water_level_file"] = nullptr;
  if (plan.water_level_file.has_value()) json["water_level_file"] = NameAndSize(*plan.water_level_file);
  json["water_classes"] = plan.water_classes;
  json["metres_per_unit"] = or_null(plan.metres_per_unit);  // Null: as the coordinate system states.
  json["wind_speed"] = plan.any_sea ? ordered_json() : formats::JsonNumber(plan.wind_speed);
  // Null if the sea is fully developed.
  json["fetch"] = plan.fetch.has_value() ? formats::JsonNumber(*plan.fetch) : ordered_json();
  json["wind_from"] = or_null(plan.wind_from);
  json["azimuth"] = plan.azimuth.has_value() ? formats::JsonNumber(*plan.azimuth) : ordered_json();
  if (const auto* beam = std::get_if<DivergingBeam>(&plan.footprint)) {
    json["divergence"] = beam->divergence;
    json["aperture"] = beam->aperture;
  } else {
    json["footprint"] = formats::JsonNumber(std::get<float>(plan.footprint));
  }
  return json;
}

}  // namespace albtpu::annotate
