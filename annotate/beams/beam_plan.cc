#include "annotate/beams/beam_plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/files/file_access.h"
#include "formats/text/text.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/trajectory_files.h"
#include "sea/angle.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 200;  // Of each run of the timeline.

// Files that a summary names one by one. It is written for each file of points, so that their number squared counts.
constexpr std::size_t kNamedFiles = 100;

}  // namespace

std::optional<TrajectoryPrecision> PrecisionOf(const std::vector<formats::ErrorsOfRun>& errors,
                                               const formats::TrajectoryTimeline& timeline) {
  std::vector<double> horizontal, vertical;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const formats::TimelineRun& run = timeline.runs()[i];
    const double first = std::max(run.span().first, timeline.points().span.first);
    const double last = std::min(run.span().last, timeline.points().span.last);
    for (int k = 0; first <= last && k < kSamples; ++k) {
      const double time = first + (last - first) * k / (kSamples - 1) - run.offset;
      const std::optional<formats::TrajectorySigma> sigma = errors[i].SigmaAt(time);
      if (!sigma.has_value()) continue;
      horizontal.push_back(std::hypot(sigma->north, sigma->east));
      vertical.push_back(sigma->down);
    }
  }
  if (horizontal.empty()) return std::nullopt;
  return TrajectoryPrecision{Median(std::move(horizontal)), Median(std::move(vertical))};
}

using nlohmann::ordered_json;

namespace {

ordered_json NameAndSize(const std::filesystem::path& path) {
  std::error_code unknown;
  return {{"name", path.filename().string()}, {"bytes", std::filesystem::file_size(path, unknown)}};
}

// Of many files, one object for all of them.
template <typename Files>
ordered_json NamesAndSizes(const Files& files) {
  ordered_json json = ordered_json::array();
  if (files.size() > kNamedFiles) {
    std::uintmax_t bytes = 0;
    for (const auto& file : files) bytes += NameAndSize(file->name())["bytes"].template get<std::uintmax_t>();
    const auto name_of = [&](std::size_t i) { return fs::path(files[i]->name()).filename().string(); };
    json.push_back({{"name", absl::StrCat(files.size(), " files, ", name_of(0), " to ", name_of(files.size() - 1))},
                    {"bytes", bytes}});
    return json;
  }
  for (const auto& file : files) json.push_back(NameAndSize(file->name()));
  return json;
}

}  // namespace

bool BeamPlan::has_direction() const {
  if (const auto* scan = std::get_if<AcrossTrackScan>(&source)) return scan->flight_direction.has_value();
  if (const auto* constant = std::get_if<ConstantIncidence>(&source)) return constant->beam_azimuth.has_value();
  return true;
}

std::vector<std::string> FilesOf(const BeamPlan& plan) {
  std::vector<std::string> files;
  if (plan.trajectories != nullptr)
    for (const auto& trajectory : *plan.trajectories) files.push_back(trajectory->name());
  for (const auto& errors : plan.trajectory_errors) files.push_back(errors->name());
  if (plan.water_level_file.has_value()) files.push_back(*plan.water_level_file);
  return files;
}

ordered_json Parameters(const BeamPlan& plan) {
  const auto or_null = [](const auto& value) { return value.has_value() ? ordered_json(*value) : ordered_json(); };
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
    if (files->velocity_axes != formats::VelocityAxes::kAuto)
      json["velocity_axes"] = std::string(formats::kVelocityAxesNames[static_cast<std::size_t>(files->velocity_axes)]);
    json["geoid_separation"] = or_null(files->geoid_separation);
    json["lever_arm"] = files->lever_arm;
  }
  if (plan.has_track() || plan.crs.has_value()) json["crs"] = or_null(plan.crs);
  if (plan.time_format != formats::TimeFormat::kAuto) json["time_format"] = formats::NameOf(plan.time_format);
  json["water_index"] = plan.has_track() ? ordered_json(plan.refractive_index) : ordered_json();
  json["water_level"] = or_null(plan.water_level);
  json["water_level_file"] = nullptr;
  if (plan.water_level_file.has_value()) json["water_level_file"] = NameAndSize(*plan.water_level_file);
  if (plan.level_reference.datum.has_value()) json["level_datum"] = *plan.level_reference.datum;
  if (plan.level_reference.offset != 0) json["level_offset"] = plan.level_reference.offset;
  if (plan.level_reference.hours_from_utc.has_value())
    json["level_hours_from_utc"] = *plan.level_reference.hours_from_utc;
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

namespace {

double Course(double north, double east) {
  const double course = DegreesOfRadians(std::atan2(east, north));
  return course < 0 ? course + 360 : course;
}

double Or(double stated, double otherwise) { return std::isfinite(stated) ? stated : otherwise; }

}  // namespace

std::optional<formats::TrajectorySigma> TrajectoryMotions::SigmaAt(double time) const {
  for (std::size_t which = 0; which < timeline_.runs().size(); ++which) {
    const formats::TimelineRun& run = timeline_.runs()[which];
    if (!(time >= run.span().first && time <= run.span().last)) continue;
    if (which < errors_.size())
      if (const auto sigma = errors_[which].SigmaAt(time - run.offset); sigma.has_value()) return sigma;
    const std::size_t next =
        formats::FirstRecordFrom(run.begin, run.end, time, [&run](std::size_t i) { return run.TimeAt(i); });
    return run.trajectory->SigmaAt(run.TimeAt(next) == time ? next : next - 1);
  }
  return std::nullopt;
}

std::optional<SensorMotion> TrajectoryMotions::At(double time) const {
  const std::optional<formats::TrajectoryRecord> record = timeline_.RecordAt(time);
  if (!record.has_value()) return std::nullopt;
  SensorMotion motion;
  motion.velocity = {Or(record->velocity_north, 0), Or(record->velocity_east, 0), -Or(record->velocity_up, 0)};
  motion.roll = DegreesOfRadians(Or(record->roll, 0));
  motion.pitch = DegreesOfRadians(Or(record->pitch, 0));
  motion.heading = std::isfinite(record->heading) ? DegreesOfRadians(record->heading)
                                                  : Course(motion.velocity[0], motion.velocity[1]);
  motion.rates = {DegreesOfRadians(Or(record->rate_forward, 0)), DegreesOfRadians(Or(record->rate_right, 0)),
                  DegreesOfRadians(Or(record->rate_down, 0))};
  if (const std::optional<formats::TrajectorySigma> sigma = SigmaAt(record->time); sigma.has_value()) {
    motion.position_sigma = {sigma->north, sigma->east, sigma->down};
    motion.attitude_sigma = {DegreesOfRadians(sigma->roll), DegreesOfRadians(sigma->pitch),
                             DegreesOfRadians(sigma->heading)};
  }
  return motion;
}

std::optional<SensorMotion> CourseMotions::At(double time) const {
  constexpr double kStep = 0.1;  // s, over which the velocity is taken: twice as far where the track begins or ends.
  const std::array<double, 3> times = {time - kStep, time, time + kStep};
  std::array<SensorPosition, 3> positions;
  std::array<TrackOutcome, 3> outcomes;
  track_.PositionsAt(times, positions, outcomes);
  const std::size_t first = outcomes[0] == TrackOutcome::kKnown ? 0 : 1;
  const std::size_t last = outcomes[2] == TrackOutcome::kKnown ? 2 : 1;
  if (first == last || outcomes[1] != TrackOutcome::kKnown) return std::nullopt;
  const SensorPosition &from = positions[first], &to = positions[last];
  const double seconds = times[last] - times[first];
  const double x = (to.x - from.x) * from.metres_per_x / seconds;
  const double y = ((to.y - from.y) * from.metres_per_y + (to.x - from.x) * from.north_per_x) / seconds;
  // True azimuth = grid azimuth + convergence.
  const double c = std::cos(from.convergence), s = std::sin(from.convergence);
  SensorMotion motion;
  motion.velocity = {y * c - x * s, x * c + y * s, -(to.z - from.z) / seconds};
  motion.heading = Course(motion.velocity[0], motion.velocity[1]);
  return motion;
}

}  // namespace albtpu::annotate
