#include "survey/commands/las_options.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "command_line/checks.h"
#include "command_line/help.h"
#include "survey/commands/commands.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

absl::Status SetFootprint(const LasOptions& options, FlightLine& line) {
  const std::optional<float>& footprint = options.fixed[Index(AxisId::kFootprint)];
  const bool computed = options.altitude.has_value() && options.divergence.has_value();
  if (footprint.has_value() && !options.altitude.has_value() && !options.divergence.has_value()) {
    line.footprint = *footprint;
  } else if (!footprint.has_value() && computed) {
    line.footprint = DivergingBeam{.altitude = *options.altitude, .divergence = *options.divergence};
  } else {
    return UsageError(
        "las: the size of the beam is missing or given twice; give either --footprint, or --altitude and "
        "--divergence");
  }
  return absl::OkStatus();
}

absl::Status SetAzimuth(const LasOptions& options, FlightLine& line) {
  const std::optional<float>& azimuth = options.fixed[Index(AxisId::kAzimuth)];
  const bool computed = options.wind_from.has_value() && options.flight_direction.has_value();
  const bool either = options.wind_from.has_value() || options.flight_direction.has_value();
  if (either != computed || (azimuth.has_value() && either)) {
    return UsageError(
        "las: the direction of the beam is incomplete or given twice; give either --azimuth, or "
        "--wind-from and --flight-direction, or none of them");
  }
  if (azimuth.has_value()) line.azimuth = *azimuth;
  if (computed) {
    line.azimuth =
        AcrossTrackScan{.flight_direction = *options.flight_direction, .wind_from = *options.wind_from};
  }
  return absl::OkStatus();
}

std::set<int> ParseClasses(const std::string& text) {
  std::set<int> classes;
  for (const std::string& item : std::vector<std::string>(absl::StrSplit(text, ','))) {
    int value = -1;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || end != item.data() + item.size() || value < 0 || value >= kClassCount) {
      throw CLI::ValidationError("--classes",
                                 absl::StrCat("'", item, "' is not a class; give whole numbers from 0 to ",
                                              kClassCount - 1, ", separated by commas"));
    }
    classes.insert(value);
  }
  return classes;
}

double ParseUnit(const std::string& text) {
  if (text == "ft") return 0.3048;              // International foot, exact.
  if (text == "us-ft") return 1200.0 / 3937.0;  // US survey foot, exact.
  return 1;                                     // m
}

}  // namespace

void AddLasOptions(CLI::App& command, LasOptions& options) {
  AddFileOptions(command, ".las", options.files, options.existing);
  AddNumber(command, "--water-level", Sign::kAny,
            "Height of the water surface, in the unit and datum of the file's heights", options.water_level)
      ->type_name("Z")
      ->group(group::kSea);
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch, AxisId::kFootprint, AxisId::kAzimuth}) {
    AddCoordinate(command, axis, options.fixed);
  }
  AddNumber(command, "--altitude", Sign::kNotNegative, "Height of the aircraft above the water [m]",
            options.altitude)
      ->group(group::kPulse);
  AddNumber(command, "--divergence", Sign::kNotNegative, "Divergence of the beam, full angle [mrad]",
            options.divergence)
      ->group(group::kPulse);
  AddNumber(command, "--wind-from", Sign::kAny,
            "Direction from which the wind blows, for across-track scanners [degree, true]",
            options.wind_from)
      ->group(group::kSea);
  AddNumber(command, "--flight-direction", Sign::kAny,
            "Direction of flight, for across-track scanners [degree, true]", options.flight_direction)
      ->group(group::kPulse);
  command
      .add_option_function<std::string>(
          "--classes", [&options](const std::string& text) { options.classes = ParseClasses(text); },
          "The classes of bathymetric points (default: 40)")
      ->type_name("N,N")
      ->group(group::kPoints);
  command
      .add_option_function<std::string>(
          "--units", [&options](const std::string& text) { options.metres_per_unit = ParseUnit(text); },
          "Unit of the file's heights and of --water-level: m, ft (international) or us-ft (US survey)")
      ->type_name("m|ft|us-ft")
      ->check(OneOf({"m", "ft", "us-ft"}))
      ->group(group::kPoints);
  AddSourceOptions(command, options.source);
  AddStyleOptions(command, options.style);
  EndHelp(command,
          absl::StrCat(
              "The beam's size is either --footprint, or --altitude and --divergence; its direction either\n"
              "--azimuth, or --wind-from and --flight-direction, or not known.\n",
              kWhereAnswersComeFrom),
          "line.las with_uncertainty.las --water-level -23.09 --wind-speed 5 --footprint 0.6",
          "surveys --output-dir annotated --recursive --water-level 0 --wind-speed 5 --wind-from 250 "
          "--flight-direction 12 --altitude 400 --divergence 1.5 --s44-order 1b");
}

absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options) {
  LasAnnotation annotation;
  annotation.classes = options.classes;
  annotation.style = options.style;
  annotation.unit_is_given = options.metres_per_unit.has_value();
  FlightLine& line = annotation.flight_line;
  if (!options.water_level.has_value()) {
    return UsageError(
        "las: --water-level is missing; give the height of the water surface in the unit and datum of the "
        "file's heights");
  }
  if (!options.fixed[Index(AxisId::kWindSpeed)].has_value()) {
    return UsageError("las: --wind-speed is missing; give the wind speed at 10 m in m/s");
  }
  line.water_level = *options.water_level;
  line.metres_per_unit = options.metres_per_unit.value_or(1);
  line.wind_speed = *options.fixed[Index(AxisId::kWindSpeed)];
  line.fetch = options.fixed[Index(AxisId::kFetch)];
  if (absl::Status status = SetFootprint(options, line); !status.ok()) return status;
  if (absl::Status status = SetAzimuth(options, line); !status.ok()) return status;
  return annotation;
}

nlohmann::ordered_json Parameters(const LasAnnotation& annotation) {
  const FlightLine& line = annotation.flight_line;
  nlohmann::ordered_json json;
  json["water_level"] = line.water_level;
  json["metres_per_unit"] = line.metres_per_unit;
  json["wind_speed"] = JsonNumber(line.wind_speed);
  // Null if the sea is fully developed.
  json["fetch"] = line.fetch.has_value() ? JsonNumber(*line.fetch) : nlohmann::ordered_json();
  if (const auto* beam = std::get_if<DivergingBeam>(&line.footprint)) {
    json["altitude"] = beam->altitude;
    json["divergence"] = beam->divergence;
  } else {
    json["footprint"] = JsonNumber(std::get<float>(line.footprint));
  }
  if (const auto* scan = std::get_if<AcrossTrackScan>(&line.azimuth)) {
    json["wind_from"] = scan->wind_from;
    json["flight_direction"] = scan->flight_direction;
  } else {
    const auto* azimuth = std::get_if<float>(&line.azimuth);
    json["azimuth"] = azimuth != nullptr ? JsonNumber(*azimuth) : nlohmann::ordered_json();
  }
  json["classes"] = annotation.classes;
  json.update(Parameters(annotation.style));
  return json;
}

}  // namespace albtpu::client
