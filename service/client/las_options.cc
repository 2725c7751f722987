#include "service/client/las_options.h"

#include <charconv>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "service/client/exit_status.h"

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
        "las: the size of the beam: either --footprint, or --altitude and --divergence, is right");
  }
  return absl::OkStatus();
}

absl::Status SetAzimuth(const LasOptions& options, FlightLine& line) {
  const std::optional<float>& azimuth = options.fixed[Index(AxisId::kAzimuth)];
  const bool computed = options.wind_from.has_value() && options.flight_direction.has_value();
  const bool either = options.wind_from.has_value() || options.flight_direction.has_value();
  if (either != computed || (azimuth.has_value() && either)) {
    return UsageError(
        "las: the direction of the beam: either --azimuth, or --wind-from and --flight-direction, or none of "
        "them, is right");
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
                                 absl::StrCat("'", item, "': whole numbers from 0 to ", kClassCount - 1,
                                              ", separated by commas, are right"));
    }
    classes.insert(value);
  }
  return classes;
}

double ParseUnit(const std::string& text) {
  if (text == "m") return 1;
  if (text == "ft") return 0.3048;              // International foot, exact.
  if (text == "us-ft") return 1200.0 / 3937.0;  // US survey foot, exact.
  throw CLI::ValidationError("--units",
                             "'" + text + "': m, ft (international) or us-ft (US survey) is right");
}

}  // namespace

void AddLasOptions(CLI::App& command, LasOptions& options) {
  command.add_option("files", options.files, "IN.las OUT.las, or with --output-dir any number of inputs")
      ->required()
      ->type_name("FILE.las");
  command
      .add_option("--output-dir", options.output_folder, "Write each output here, by the name of its input")
      ->type_name("DIR");
  AddNumber(command, "--water-level", Sign::kAny, "Height of the water surface, in the heights of the file",
            options.water_level)
      ->type_name("Z");
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch, AxisId::kFootprint, AxisId::kAzimuth}) {
    AddCoordinate(command, axis, options.fixed);
  }
  AddNumber(command, "--altitude", Sign::kNotNegative, "Height of the aircraft above the water [m]",
            options.altitude);
  AddNumber(command, "--divergence", Sign::kNotNegative, "Full angle of the beam's divergence [mrad]",
            options.divergence);
  AddNumber(command, "--wind-from", Sign::kAny,
            "Where the wind comes from [degree, true]; across-track scanners", options.wind_from);
  AddNumber(command, "--flight-direction", Sign::kAny,
            "Where the aircraft goes [degree, true]; across-track scanners", options.flight_direction);
  command
      .add_option_function<std::string>(
          "--classes", [&options](const std::string& text) { options.classes = ParseClasses(text); },
          "The classes that are bathymetric, 40 if left out")
      ->type_name("N,N");
  command
      .add_option_function<std::string>(
          "--units", [&options](const std::string& text) { options.metres_per_unit = ParseUnit(text); },
          "Unit of the heights of the file and of --water-level: m, ft (international) or us-ft (US survey)")
      ->type_name("m|ft|us-ft");
  AddSharedOptions(command, options.shared);
}

absl::StatusOr<std::vector<Job>> Jobs(const LasOptions& options) {
  const std::vector<std::string>& files = options.files;
  if (options.output_folder.empty()) {
    if (files.size() != 2) {
      return UsageError(absl::StrCat("las: ", files.size(),
                                     " files: IN.las OUT.las is right, or --output-dir DIR "
                                     "and any number of inputs"));
    }
    return std::vector<Job>{{files[0], files[1]}};
  }
  std::vector<Job> jobs;
  std::set<std::filesystem::path> names;
  for (const std::string& file : files) {
    const std::filesystem::path input(file);
    if (!names.insert(input.filename()).second) {
      return UsageError(absl::StrCat("--output-dir: two inputs are called ", input.filename().string(),
                                     ": give them one at a time, as IN.las OUT.las"));
    }
    jobs.push_back({input, options.output_folder / input.filename()});
  }
  return jobs;
}

absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options) {
  LasAnnotation annotation;
  annotation.classes = options.classes;
  annotation.style = options.shared.style;
  annotation.unit_is_given = options.metres_per_unit.has_value();
  FlightLine& line = annotation.flight_line;
  if (!options.water_level.has_value()) {
    return UsageError(
        "las: no --water-level: give the height of the water surface in the heights of the file");
  }
  if (!options.fixed[Index(AxisId::kWindSpeed)].has_value()) {
    return UsageError("las: no --wind-speed: give the wind at 10 m in m/s");
  }
  line.water_level = *options.water_level;
  line.metres_per_unit = options.metres_per_unit.value_or(1);
  line.wind_speed = *options.fixed[Index(AxisId::kWindSpeed)];
  line.fetch = options.fixed[Index(AxisId::kFetch)];
  if (absl::Status status = SetFootprint(options, line); !status.ok()) return status;
  if (absl::Status status = SetAzimuth(options, line); !status.ok()) return status;
  return annotation;
}

}  // namespace albtpu::client
