// albtpu_simulated_survey FOLDER [flags]
//
// Writes a survey of which the truth is known:
//   flight.las, or flight_1.las, flight_2.las, ...   the points
//   flight.truth, ...                                the truth of each point, doubles (kTruthColumns of survey_files.h)
//   sbet.out, smrmsg.out, trajectory.txt             the trajectory
//   survey.json                                      what a user knows, and the columns of the truth
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/flights/survey_files.h"

namespace albtpu::testing {
namespace {

struct Options {
  std::filesystem::path folder;
  SurveyOptions survey;
  TrajectoryOptions trajectory;
  PointOptions points;
  std::string scanner = "palmer", time = "adjusted";
  int files = 1;
  bool file_for_each_line = false, shuffle = false;
};

// The degrees of the command line, which become the radians of the options.
struct Degrees {
  std::vector<double> origin = {27.0, -80.1}, boresight = {0.1, -0.05, 0.2}, lever_arm = {0.3, -0.2, 0.5};
  std::vector<double> wave_slopes = {0, 0};
  double course = 35, crab_angle = 5, wander = 20, scan_noise = 0, wind_from = 0;
};

void AddFlags(CLI::App& app, Options& options, Degrees& degrees) {
  SurveyOptions& survey = options.survey;
  app.add_option("FOLDER", options.folder, "Where the files are written")->required();
  app.add_option("--scanner", options.scanner, "palmer, ellipse or raster")
      ->check(CLI::IsMember({"palmer", "cone", "ellipse", "raster"}));
  app.add_option("--seed", survey.seed, "Of the motion of the aircraft, of the waves and of the noise");
  app.add_option("--grid", survey.grid, "Coordinate system")
      ->check(CLI::IsMember(
          {"utm16n", "utm17n", "utm18n", "florida-east-ft", "laea-europe", "geographic", "geographic-360"}));
  app.add_option("--origin", degrees.origin, "LATITUDE,LONGITUDE where the survey begins [degree]")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--start", survey.start, "Beginning of the first line [s of the GPS week]");
  app.add_option("--week", options.points.gps_week, "GPS week");
  app.add_option("--seconds", survey.seconds, "Length of each line [s]");
  app.add_option("--lines", survey.lines, "Number of lines");
  app.add_option("--cross-lines", survey.cross_lines, "Number of further lines, across the others");
  app.add_option("--course", degrees.course, "Course of the first line [degree]");
  app.add_option("--crab-angle", degrees.crab_angle, "Heading less course [degree]");
  app.add_option("--altitude", survey.altitude, "Above the water [m]");
  app.add_option("--speed", survey.speed, "[m/s]");
  app.add_option("--pulse-rate", survey.pulse_rate, "[Hz]");
  app.add_option("--scan-rate", survey.scan_rate, "[Hz]");
  app.add_option("--lever-arm", degrees.lever_arm, "X,Y,Z forward, right, down [m]")->delimiter(',')->expected(3);
  app.add_option("--boresight", degrees.boresight, "ROLL,PITCH,HEADING [degree]")->delimiter(',')->expected(3);
  app.add_option("--water-level", survey.water_level, "Above the ellipsoid [m]");
  app.add_option("--wave-height", survey.wave_height, "Significant wave height [m]");
  app.add_option("--range-noise", survey.range_noise, "One sigma [m]");
  app.add_flag("--trajectory-errors", survey.errors.trajectory,
               "Deliver points with the errors that the trajectory's files state");
  app.add_option("--scan-noise", degrees.scan_noise, "Deliver points with errors of the scan, one sigma [degree]");
  app.add_option("--wave-slopes", degrees.wave_slopes, "ALONG,ACROSS the wind, one sigma, drawn anew for each pulse")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--wind-from", degrees.wind_from, "Of the slopes [degree]");
  app.add_option("--column-share", survey.column_share, "Share of the pulses with a return from the water column");
  app.add_option("--surface-share", survey.surface_share, "Share of the pulses with a return from the surface");
  app.add_option("--sbet-rate", options.trajectory.rate, "[Hz]");
  app.add_option("--smrmsg-rate", options.trajectory.error_rate, "[Hz]");
  app.add_option("--margin", options.trajectory.margin, "Of the trajectory around each line [s]");
  app.add_option("--wander", degrees.wander, "Wander angle where the survey begins [degree]");
  app.add_option("--gap-start", options.trajectory.gap_start, "Of a gap in the trajectory, in the first line [s]");
  app.add_option("--gap", options.trajectory.gap, "Length of that gap [s]");
  app.add_option("--clock", options.trajectory.clock, "Added to the times of the trajectory; -18: UTC [s]");
  app.add_option("--las-version", options.points.version_minor, "Of LAS: 2, 3 or 4")->check(CLI::Range(2, 4));
  app.add_option("--point-format", options.points.point_format, "0 to 10")->check(CLI::Range(0, 10));
  app.add_option("--time", options.time, "Times of the points: adjusted (GPS time less 1e9 s) or week")
      ->check(CLI::IsMember({"adjusted", "week"}));
  app.add_option("--geoid-separation", options.points.geoid_separation, "Of the heights of the points [m]");
  app.add_option("--divergence", options.points.divergence, "Full angle, for the footprints of the truth [mrad]");
  app.add_option("--scale", options.points.scale, "Resolution of the points [units of the grid]");
  app.add_flag("--geotiff-keys", options.points.geotiff_keys, "No well-known text in the LAS files");
  app.add_flag("--no-source-id", options.points.no_source_id, "Points do not name their line");
  app.add_option("--files", options.files, "LAS files of equal size, in the order of time")->check(CLI::PositiveNumber);
  app.add_flag("--file-for-each-line", options.file_for_each_line, "A LAS file for each line");
  app.add_flag("--shuffle", options.shuffle, "Points in random order");
}

void Convert(const Degrees& degrees, Options& options) {
  SurveyOptions& survey = options.survey;
  survey.scanner = *FindScanner(options.scanner);
  survey.latitude = degrees.origin[0] * kDegree;
  survey.longitude = degrees.origin[1] * kDegree;
  survey.course = degrees.course * kDegree;
  survey.crab_angle = degrees.crab_angle * kDegree;
  survey.errors.scan = degrees.scan_noise * kDegree;
  survey.errors.slope_along = degrees.wave_slopes[0];
  survey.errors.slope_across = degrees.wave_slopes[1];
  survey.errors.wind_from = degrees.wind_from * kDegree;
  survey.lever_arm = Eigen::Vector3d(degrees.lever_arm.data());
  survey.boresight = Eigen::Vector3d(degrees.boresight.data()) * kDegree;
  options.trajectory.wander = degrees.wander * kDegree;
  options.points.adjusted_time = options.time == "adjusted";
}

// The returns of each file.
std::vector<std::vector<std::size_t>> Split(const SimulatedSurvey& survey, const Options& options) {
  const std::size_t count = survey.returns.size(), files = static_cast<std::size_t>(options.files);
  std::vector<std::vector<std::size_t>> parts(options.file_for_each_line ? static_cast<std::size_t>(survey.lines())
                                                                         : files);
  RandomNumbers random(survey.options.seed + 1);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    const auto line = static_cast<std::size_t>(survey.pulses[survey.returns[i].pulse].line);
    parts[options.file_for_each_line ? line - 1 : i * files / count].push_back(i);
  }
  for (std::vector<std::size_t>& part : parts)  // Fisher and Yates.
    for (std::size_t i = part.size(); options.shuffle && i > 1; --i)
      std::swap(part[i - 1], part[static_cast<std::size_t>(random.Uniform(0, static_cast<double>(i)))]);
  return parts;
}

bool Write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes << std::flush;
  if (!file) std::cerr << "albtpu_simulated_survey: " << path.string() << " cannot be written; give another folder\n";
  return static_cast<bool>(file);
}

int Run(const Options& options) {
  std::error_code ignored;
  std::filesystem::create_directories(options.folder, ignored);
  const SimulatedSurvey survey = Simulate(options.survey);
  nlohmann::ordered_json json;
  // In the unit and datum of the heights of the points.
  const double unit = FindMapGrid(options.survey.grid)->metres_per_unit;
  json["water_level"] = (options.survey.water_level - options.points.geoid_separation) / unit;
  json["metres_per_unit"] = unit;
  json["points"] = survey.returns.size();
  for (const char* column : kTruthColumns) json["truth_columns"].push_back(column);
  const std::vector<std::vector<std::size_t>> parts = Split(survey, options);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string name = "flight" + (parts.size() > 1 ? "_" + std::to_string(i + 1) : std::string());
    json["files"].push_back(name);
    if (!Write(options.folder / (name + ".las"), BuildLas(PointsOf(survey, parts[i], options.points)))) return 1;
    if (!Write(options.folder / (name + ".truth"), TruthOf(survey, parts[i], options.points))) return 1;
  }
  return Write(options.folder / "sbet.out", SbetFile(survey, options.trajectory)) &&
                 Write(options.folder / "smrmsg.out", SmrmsgFile(survey, options.trajectory)) &&
                 Write(options.folder / "trajectory.txt", AsciiTrajectory(survey, options.trajectory)) &&
                 Write(options.folder / "survey.json", json.dump(2) + "\n")
             ? 0
             : 1;
}

}  // namespace
}  // namespace albtpu::testing

int main(int argc, char** argv) {
  using namespace albtpu::testing;
  CLI::App app("Writes a simulated survey of which the truth is known: LAS files and trajectory");
  Options options;
  Degrees degrees;
  AddFlags(app, options, degrees);
  CLI11_PARSE(app, argc, argv);
  Convert(degrees, options);
  return Run(options);
}
