// The flags of BeamOptions and how their texts are read.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "command_line/checks.h"
#include "survey/commands/beam_options.h"
#include "survey/las/las_points.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

constexpr double kFoot = 0.3048;                 // m, international; exact.
constexpr double kSurveyFoot = 1200.0 / 3937.0;  // m, US survey; exact.
constexpr double kLongestLeverArm = 100;         // m; longer than any survey aircraft.

std::array<double, 3> ParseLeverArm(const std::string& text) {
  const std::vector<std::string> items = absl::StrSplit(text, ',');
  std::array<double, 3> arm = {};
  bool numbers = items.size() == arm.size();
  for (std::size_t i = 0; numbers && i < arm.size(); ++i) {
    const std::optional<double> value = ParseDouble(items[i]);
    numbers = value.has_value() && std::isfinite(*value);
    if (numbers) arm[i] = *value;
  }
  for (const double component : arm) {
    if (!numbers || std::abs(component) <= kLongestLeverArm) continue;
    throw CLI::ValidationError(
        "--lever-arm", absl::StrCat("'", text, "' is longer than an aircraft (", std::abs(component),
                                    " m; is it in mm?); give three numbers in m: forward,right,down"));
  }
  if (numbers) return arm;
  throw CLI::ValidationError(
      "--lever-arm",
      absl::StrCat("'", text, "' is not a lever arm; give three numbers in m: forward,right,down"));
}

void CheckWaterLevel(const std::string& text) {
  const std::optional<double> value = ParseDouble(text);
  if (!text.empty() && (!value.has_value() || std::isfinite(*value))) return;
  throw CLI::ValidationError("--water-level", absl::StrCat("'", text,
                                                           "' is not a finite number; give a height, or a "
                                                           "CSV file of heights by time"));
}

double ParseUnit(const std::string& text) { return text == "ft" ? kFoot : text == "us-ft" ? kSurveyFoot : 1; }

void AddWays(CLI::App& command, BeamOptions& options) {
  const auto paths = [&](const char* flag, std::vector<std::string>& values, const char* description) {
    command.add_option(flag, values, description)
        ->type_name("PATH")
        ->check(NotEmpty("file"))
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group(group::kBeam);
  };
  paths("--trajectory", options.trajectory,
        "Trajectory of the sensor, SBET or ASCII: a file or a folder of files; may be repeated");
  paths("--trajectory-errors", options.trajectory_errors,
        "Its errors, SMRMSG: a file or a folder of files; may be repeated");
  command
      .add_option("--trajectory-time", options.trajectory_time, "Time scale of the trajectory (default: gps)")
      ->type_name("gps|utc")
      ->check(OneOf({"gps", "utc"}))
      ->group(group::kBeam);
  AddNumber(
      command, "--geoid-separation", Sign::kAny,
      "Height of the points' vertical datum above the ellipsoid, where the points are not ellipsoidal [m]",
      options.geoid_separation)
      ->group(group::kBeam);
  command
      .add_option_function<std::string>(
          "--lever-arm", [&options](const std::string& text) { options.lever_arm = ParseLeverArm(text); },
          "From the trajectory's reference point to the laser, in body axes: forward, right, down [m]")
      ->type_name("X,Y,Z")
      ->group(group::kBeam);
  command
      .add_option("--crs", options.crs,
                  "Coordinate system of the points, such as EPSG:26917, in place of what the files state")
      ->type_name("CODE")
      ->check(NotEmpty("coordinate system"))
      ->group(group::kBeam);
  command
      .add_flag("--trajectory-from-returns", options.from_returns,
                "Find the trajectory from pulses with two returns under water")
      ->group(group::kBeam);
  command
      .add_option("--scanner", options.scanner,
                  "The scanner swings across the track: incidence is |scan angle|")
      ->type_name("across-track")
      ->check(OneOf({"across-track"}))
      ->group(group::kBeam);
  AddNumber(command, "--flight-direction", Sign::kAny,
            "Direction of flight, for --scanner across-track [degree, true]", options.flight_direction)
      ->group(group::kBeam);
  AddNumber(command, "--incidence", Sign::kNotNegative,
            "One angle of all beams from the vertical, in air, as of a cone [degree]", options.incidence)
      ->group(group::kBeam);
  AddNumber(command, "--beam-azimuth", Sign::kAny,
            "Where the beams travel to, for --incidence [degree, true]", options.beam_azimuth)
      ->group(group::kBeam);
}

void AddWater(CLI::App& command, BeamOptions& options) {
  command
      .add_option_function<std::string>(
          "--water-level",
          [&options](const std::string& text) {
            CheckWaterLevel(text);
            options.water_level = text;
          },
          "Height of the water surface, in the unit and datum of the file's heights, or a CSV file of "
          "heights by time")
      ->type_name("Z|FILE.csv")
      ->group(group::kSea);
  command
      .add_option_function<std::string>(
          "--water-classes",
          [&options](const std::string& text) {
            options.water_classes = ParseClasses("--water-classes", text);
          },
          "The classes of returns from the water surface; they take precedence over --water-level")
      ->type_name("N,N")
      ->group(group::kSea);
  AddNumber(command, "--water-index", Sign::kNotNegative,
            absl::StrCat("Refractive index of the water (default: ", kSeaWaterIndex, ")"),
            options.water_index)
      ->group(group::kSea);
}

}  // namespace

std::set<int> ParseClasses(const std::string& flag, const std::string& text) {
  std::set<int> classes;
  for (const std::string& item : std::vector<std::string>(absl::StrSplit(text, ','))) {
    int value = -1;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || end != item.data() + item.size() || value < 0 || value >= kClassCount) {
      throw CLI::ValidationError(
          flag, absl::StrCat("'", item, "' is not a class; give whole numbers from 0 to ", kClassCount - 1,
                             ", separated by commas"));
    }
    classes.insert(value);
  }
  return classes;
}

void AddBeamOptions(CLI::App& command, BeamOptions& options) {
  AddWays(command, options);
  AddWater(command, options);
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch, AxisId::kFootprint, AxisId::kAzimuth}) {
    AddCoordinate(command, axis, options.fixed);
  }
  AddNumber(command, "--altitude", Sign::kNotNegative,
            "Height of the aircraft above the water, where no trajectory gives it [m]", options.altitude)
      ->group(group::kPulse);
  AddNumber(command, "--divergence", Sign::kNotNegative, "Divergence of the beam, full angle [mrad]",
            options.divergence)
      ->group(group::kPulse);
  AddNumber(command, "--aperture", Sign::kNotNegative,
            "Diameter of the beam where it leaves the sensor, with --divergence [m] (default: 0)",
            options.aperture)
      ->group(group::kPulse);
  AddNumber(command, "--wind-from", Sign::kAny, "Direction from which the wind blows [degree, true]",
            options.wind_from)
      ->group(group::kSea);
  command
      .add_option_function<std::string>(
          "--units", [&options](const std::string& text) { options.metres_per_unit = ParseUnit(text); },
          "Unit of the file's heights and of --water-level: m, ft (international) or us-ft (US survey) "
          "(default: that "
          "of the file's coordinate system)")
      ->type_name("m|ft|us-ft")
      ->check(OneOf({"m", "ft", "us-ft"}))
      ->group(group::kPoints);
}

}  // namespace albtpu::client
