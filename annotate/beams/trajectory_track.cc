#include "annotate/beams/trajectory_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/beams/clocked_track.h"
#include "annotate/beams/projected_track.h"
#include "budget/beams/track_check.h"
#include "formats/clocks/point_clock.h"
#include "formats/trajectories/trajectory_timeline.h"
#include "sea/angle.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

// Positions of `track` in the local frame, `shift` [s] after the given times.
TrackPositions LocalPositions(const SensorTrack& track, const formats::LocalFrame& frame, double shift = 0) {
  return [&track, &frame, shift](std::span<const double> times, std::span<Eigen::Vector3d> positions) {
    std::vector<double> shifted(times.begin(), times.end());
    for (double& time : shifted) time += shift;
    std::vector<SensorPosition> sensors(times.size());
    std::vector<TrackOutcome> outcomes(times.size());
    track.PositionsAt(shifted, sensors, outcomes);
    for (std::size_t i = 0; i < times.size(); ++i)
      if (outcomes[i] == TrackOutcome::kKnown)
        positions[i] << frame.At(sensors[i].x, sensors[i].y), sensors[i].z;
      else
        positions[i].setConstant(std::numeric_limits<double>::quiet_NaN());
  };
}

absl::Status StatePrecision(const TrackedFile& file, const std::vector<formats::ErrorsOfRun>& errors,
                            const formats::TrajectoryTimeline& timeline, FileTrack& found) {
  const std::optional<TrajectoryPrecision> precision = PrecisionOf(errors, timeline);
  if (!precision.has_value()) {
    return absl::FailedPreconditionError(
        absl::StrCat(file.name,
                     ": no error file of --trajectory-errors covers the times of its points; give those of "
                     "this trajectory"));
  }
  std::set<std::string> left_out;
  for (const formats::ErrorsOfRun& of_run : errors) left_out.insert(of_run.left_out.begin(), of_run.left_out.end());
  for (const formats::ErrorsOfRun& of_run : errors)
    for (const auto& used : of_run.files) left_out.erase(used->name());
  if (!left_out.empty())
    found.notes.push_back(absl::StrCat("error files of other flights at the same seconds of a week are left out: ",
                                       absl::StrJoin(left_out, ", ")));
  (*found.json)["sigma"] = {{"horizontal", precision->horizontal}, {"vertical", precision->vertical}};
  found.notes.push_back(
      absl::StrFormat("trajectory known to %.3f m horizontally and %.3f m vertically (1 sigma, median)",
                      precision->horizontal, precision->vertical));
  return absl::OkStatus();
}

// If the track agrees with the rays on the other time scale, a hint with the flag that selects it; otherwise empty.
std::optional<std::string> FlagOfOtherClock(const TrackedFile& file, const SensorTrack& track, bool utc, double index) {
  // GPS - UTC since July 2012. Times in UTC that are taken for GPS put a position so many seconds too early.
  for (const int seconds : {18, 17, 16}) {
    const double shift = utc ? seconds : -seconds;
    const TrackCheck check = CheckTrack(file.rays, LocalPositions(track, file.frame, shift), {.index = index});
    if (check.verdict != TrackVerdict::kAgrees) continue;
    return absl::StrCat("its times are ", utc ? "GPS" : "UTC", ", ", seconds, " s ", utc ? "after UTC" : "behind GPS",
                        "); give --trajectory-time ", utc ? "gps" : "utc");
  }
  return std::nullopt;
}

// A water level that is too high by h puts the sensor too high by h (1 - tan(w) / tan(a)), with the angles w and a of
// the ray in water and in air, because rays are refracted at the wrong height. Near the vertical that is h (1 - 1/n),
// and up to 25 degrees at most 1.2 times as much. The returns cannot distinguish it from a trajectory that is too low.
// Empty where the level does not come from --water-level.
std::string OrWaterLevel(const TrackCheck& check, const BeamPlan& plan) {
  if (check.verdict != TrackVerdict::kHeightOffset || !plan.water_classes.empty()) return "";
  const double error = check.up.value / (1 - 1 / plan.refractive_index);
  return absl::StrFormat(", or --water-level is about %.2g m too %s", std::abs(error), error < 0 ? "low" : "high");
}

// Compares the track with the rays of pairs of returns.
absl::Status CheckAgainstReturns(const TrackedFile& file, const BeamPlan& plan, bool utc, FileTrack& found) {
  const double index = plan.refractive_index;
  const TrackCheck check = CheckTrack(file.rays, LocalPositions(*found.track, file.frame), {.index = index});
  ordered_json& json = (*found.json)["check"];
  json["rays"] = check.rays;
  if (check.verdict == TrackVerdict::kTooFewRays) {
    json["verdict"] = "too few rays";
    found.notes.push_back(absl::StrCat("trajectory not compared with the returns (", check.rays,
                                       " pulses with two returns under water are too few",
                                       check.rays < TrackCheckOptions().min_rays ? "" : " in so short a time",
                                       file.remark.empty() ? "" : "; ", file.remark, ")"));
    return absl::OkStatus();
  }
  if (Disagrees(check.verdict)) {
    const std::string problem = absl::StrCat(file.name, ": its returns contradict the trajectory (");
    const std::optional<std::string> flag = FlagOfOtherClock(file, *found.track, utc, index);
    if (flag.has_value()) return absl::FailedPreconditionError(absl::StrCat(problem, *flag));
    return absl::FailedPreconditionError(
        absl::StrCat(problem, Describe(check), OrWaterLevel(check, plan), "; the median angle between beams is ",
                     absl::StrFormat("%.2g", DegreesOfRadians(check.median_angle)),
                     " degrees); correct the flags that say how to read the trajectory, or give the right one if this "
                     "is that of another flight"));
  }
  const double difference = DegreesOfRadians(check.mean_difference.value);
  const double sigma = DegreesOfRadians(check.mean_difference.sigma);
  json["verdict"] = "agrees";
  json["mean_incidence_difference"] = difference;
  json["mean_incidence_difference_sigma"] = sigma;
  found.notes.push_back(
      absl::StrFormat("trajectory agrees with %d pulses that have two returns under water: incidence differs "
                      "by %.3f degrees in the "
                      "mean",
                      check.rays, difference));
  return absl::OkStatus();
}

// The part of the points' time that records must cover where the clock of the points is not that of their file: by
// chance, a flight of another day touches it.
constexpr double kLeastCovered = 0.5;

double CoveredPart(const formats::TrajectoryTimeline& timeline) {
  const formats::TimeSpan& points = timeline.points().span;
  double covered = 0;
  for (const formats::TimelineRun& run : timeline.runs()) covered += std::max(0.0, Overlap(run.span(), points));
  return points.last > points.first ? covered / (points.last - points.first) : 1;
}

// FileTrack::week
std::optional<double> WeekOf(const formats::TrajectoryTimeline& timeline) {
  if (timeline.points().form != formats::PointTimeForm::kWeekSeconds) return std::nullopt;
  // From 2000 to September 2011, GPS times since 1980 are as large as adjusted ones after 2031.
  constexpr double kFirstAmbiguous = 6.3e8;
  const formats::TimelineRun& run = timeline.runs().front();
  const double stated = run.trajectory->TimeAt(run.begin);
  const std::optional<double> gps = formats::GpsTimeOfTrajectory(stated);
  if (!gps.has_value() || (stated >= kFirstAmbiguous && stated < formats::kAdjustedGpsOffset)) return std::nullopt;
  return *gps - formats::kAdjustedGpsOffset - (stated + run.offset);
}

constexpr double kHalfDay = 43200;  // s

void NoteRemarks(const formats::TrajectoryTimeline& timeline, FileTrack& found) {
  for (const formats::TimelineRun& run : timeline.runs()) {
    const std::string& remark = run.trajectory->remark();
    if (!remark.empty() && std::find(found.notes.begin(), found.notes.end(), remark) == found.notes.end())
      found.notes.push_back(remark);
  }
}

// UTC that neither the points nor the trajectory gives a date.
void NoteLeapSeconds(const formats::TrajectoryTimeline& timeline, FileTrack& found) {
  const formats::PointTimes& points = timeline.points();
  const double stated = timeline.runs().front().trajectory->TimeAt(0);
  if (points.form != formats::PointTimeForm::kWeekSeconds || formats::GpsTimeOfTrajectory(stated).has_value()) return;
  found.notes.push_back(
      points.created.has_value()
          ? absl::StrFormat(
                "GPS - UTC of the trajectory is taken as %d s, that of %s, when the file was created by its "
                "header",
                formats::GpsMinusUtc(*points.created), formats::DateText(*points.created + kHalfDay))
          : absl::StrFormat("GPS - UTC of the trajectory is taken as %g s, that since 2017, because the header of the "
                            "file does not state when it was created",
                            formats::kGpsMinusUtcNow));
}

absl::StatusOr<FileTrack> TrackByClock(const TrackedFile& stated, const BeamPlan& plan,
                                       const formats::PointClock& clock, double least_covered = 0);

// An SBET does not name its week: of files of the same hours, those that lie at the points and agree with the returns,
// each by itself. Fails with `contradiction` where that leaves out none, or all.
absl::StatusOr<FileTrack> TrackOfThisWeek(const TrackedFile& stated, const BeamPlan& plan,
                                          const formats::PointClock& clock, double least_covered,
                                          const absl::Status& contradiction) {
  constexpr std::size_t kMost = 64;  // Files of one hour; each is projected.
  const std::vector<std::size_t> near = plan.trajectories->NearTimesOf(clock(stated.times.span));
  if (near.size() < 2 || near.size() > kMost) return contradiction;
  formats::TrajectoryFiles::Files fitting;
  std::vector<std::string> others;
  BeamPlan chosen = plan;
  chosen.trajectory_errors = {};  // They are sought for the flight that is found.
  for (const std::size_t i : near) {
    const std::shared_ptr<const formats::Trajectory>& file = (*plan.trajectories)[i];
    chosen.trajectories = std::make_shared<const formats::TrajectoryFiles>(formats::TrajectoryFiles::Files{file});
    if (TrackByClock(stated, chosen, clock).ok())
      fitting.push_back(file);
    else
      others.push_back(file->name());
  }
  if (fitting.empty() || others.empty()) return contradiction;
  chosen.trajectories = std::make_shared<const formats::TrajectoryFiles>(std::move(fitting));
  chosen.trajectory_errors = plan.trajectory_errors;
  ASSIGN_OR_RETURN(FileTrack found, TrackByClock(stated, chosen, clock, least_covered));
  found.notes.push_back(absl::StrCat("of the trajectories of these hours of a week, ", absl::StrJoin(others, ", "),
                                     others.size() > 1 ? " are" : " is", " not of this flight and left out"));
  return found;
}

// `least_covered`: the part of the points' time at which there must be records.
absl::StatusOr<FileTrack> TrackByClock(const TrackedFile& stated, const BeamPlan& plan,
                                       const formats::PointClock& clock, double least_covered) {
  const TrajectoryFromFiles& source = std::get<TrajectoryFromFiles>(plan.source);
  formats::PointTimes times = clock(stated.times.span);
  times.created = stated.times.created;
  absl::StatusOr<formats::TrajectoryTimeline> timeline = formats::TrajectoryTimeline::Create(
      *plan.trajectories, source.utc ? formats::TrajectoryClock::kUtc : formats::TrajectoryClock::kGps, times);
  if (!timeline.ok()) {
    return TrackOfThisWeek(stated, plan, clock, least_covered,
                           absl::Status(timeline.status().code(),
                                        absl::StrCat(stated.name, ": ", std::string(timeline.status().message()))));
  }
  if (CoveredPart(*timeline) < least_covered)
    return absl::FailedPreconditionError(absl::StrCat(stated.name, ": few of its points have a trajectory"));
  TrackedFile changed;
  if (clock.changes_times()) changed = ByClock(stated, clock);
  const TrackedFile& file = clock.changes_times() ? changed : stated;
  FileTrack found;
  found.clock = clock;
  found.week = WeekOf(*timeline);
  NoteRemarks(*timeline, found);
  if (source.utc) NoteLeapSeconds(*timeline, found);
  absl::StatusOr<std::vector<formats::ErrorsOfRun>> errors = plan.trajectory_errors.Of(*timeline);
  if (!errors.ok())
    return absl::Status(errors.status().code(), absl::StrCat(file.name, ": ", errors.status().message()));
  if (!plan.trajectory_errors.empty()) RETURN_IF_ERROR(StatePrecision(file, *errors, *timeline, found));
  RETURN_IF_ERROR(formats::CheckNearPoints(file.name, *timeline, *file.map, file.extent));
  found.motions = std::make_unique<TrajectoryMotions>(*timeline, *std::move(errors));
  ASSIGN_OR_RETURN(found.track,
                   ProjectedTrack::Create(*std::move(timeline), file.map,
                                          {.lever_arm = {source.lever_arm[0], source.lever_arm[1], source.lever_arm[2]},
                                           .geoid_separation = source.geoid_separation.value_or(0)}));
  RETURN_IF_ERROR(CheckAgainstReturns(file, plan, source.utc, found));
  if (!clock.changes_times()) return found;
  found.track = std::make_unique<ClockedTrack>(std::move(found.track), clock);
  found.motions = std::make_unique<ClockedMotions>(std::move(found.motions), clock);
  return found;
}

// What to do where several clocks fit.
std::string OneFlagOf(std::span<const formats::PointClock> clocks) {
  std::set<std::string> flags;
  for (const formats::PointClock& clock : clocks)
    if (clock.format != formats::TimeFormat::kAuto) flags.insert(formats::TimeFormatFlag(clock));
  if (flags.size() < 2) return "give the trajectory of this flight alone";
  return absl::StrCat("give ", absl::StrJoin(flags, " or "));
}

// The date of a day of the week that was found by what fits, as far as trajectory or header tell it.
std::string DayText(const formats::PointClock& clock, const formats::PointTimes& times, std::optional<double> date) {
  if (!clock.is_of_day()) return "";
  if (date.has_value()) return absl::StrCat("; by the trajectory, the day is ", formats::DateText(*date));
  if (!times.created.has_value()) return "";
  const double noon = *times.created + kHalfDay;
  return absl::StrCat("; by its header, the file was created on ", formats::DayOfWeek(noon), ", ",
                      formats::DateText(noon));
}

// Where no clock fits: what times of a day would be, which are nothing else by themselves.
absl::Status OrOfDay(const TrackedFile& file, const BeamPlan& plan, const absl::Status& failure) {
  if (!formats::MayBeOfDay(file.times.span)) return failure;
  const formats::Trajectory& first = *plan.trajectories->front();
  const formats::TimeSpan span = {first.TimeAt(0), first.TimeAt(first.size() - 1)};
  const std::optional<double> date = formats::GpsTimeOfTrajectory(span.first);
  const double gps = date.value_or(span.first);
  return absl::Status(
      failure.code(),
      absl::StrCat(std::string(failure.message()), "; or, if its times are seconds of the day, ",
                   formats::HoursText(file.times.span),
                   file.times.created.has_value()
                       ? absl::StrCat(" (its header states ", formats::DateText(*file.times.created + kHalfDay), ")")
                       : "",
                   ", the trajectory of that hour (", first.name(), " has ",
                   formats::HoursText({gps, gps + span.last - span.first}), " of ",
                   date.has_value() ? formats::DateText(gps) : absl::StrCat("a ", formats::DayOfWeek(gps)),
                   "), with --time-format day, or utc-day for UTC"));
}

// Where the clock that the user names does not fit: the one that does.
absl::Status OtherFormat(const TrackedFile& file, const BeamPlan& plan, const absl::Status& failure) {
  BeamPlan any = plan;
  any.time_format = formats::TimeFormat::kAuto;
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file, any);
  if (!found.ok()) return failure;
  const ordered_json& json = *found->json;
  return absl::FailedPreconditionError(absl::StrCat(
      file.name, ": the trajectory does not lie at its points if --time-format ", formats::NameOf(plan.time_format),
      " is right, ",
      json.contains("time_format")
          ? absl::StrCat("but as their GPS times are by --time-format ", json["time_format"].get<std::string>())
          : "but as its header states their GPS times",
      "; give that, or leave the flag out"));
}

}  // namespace

absl::StatusOr<FileTrack> TrackFromFiles(const TrackedFile& file, const BeamPlan& plan) {
  const formats::TimeFormat format = plan.time_format;
  const bool is_chosen = format != formats::TimeFormat::kAuto;
  const std::optional<double> date = formats::GpsTimeOfTrajectory(plan.trajectories->front()->TimeAt(0));
  const std::vector<formats::PointClock> clocks = formats::ClocksOf(file.times, format, date);
  if (clocks.empty()) {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s: the GPS times of its points, %.15g to %.15g, cannot be what --time-format %s says; leave "
                        "the flag out, and what they are is found by what fits",
                        file.name, file.times.span.first, file.times.span.last, formats::NameOf(format)));
  }
  absl::StatusOr<FileTrack> first = TrackByClock(file, plan, clocks.front());
  if (first.ok() && !is_chosen) return first;
  std::vector<formats::PointClock> fitting;
  std::optional<FileTrack> found;
  if (first.ok()) {
    fitting.push_back(clocks.front());
    found = *std::move(first);
  }
  for (std::size_t i = 1; i < clocks.size(); ++i) {
    absl::StatusOr<FileTrack> track = TrackByClock(file, plan, clocks[i], kLeastCovered);
    if (!track.ok()) {
      // The day that is meant fails for another reason than that it has no records.
      if (is_chosen && absl::IsInvalidArgument(first.status()) && absl::IsFailedPrecondition(track.status()))
        first = track.status();
      continue;
    }
    fitting.push_back(clocks[i]);
    found = *std::move(track);
  }
  if (fitting.empty()) return is_chosen ? OtherFormat(file, plan, first.status()) : OrOfDay(file, plan, first.status());
  if (fitting.size() > 1) {
    return absl::FailedPreconditionError(absl::StrCat(
        file.name, ": its GPS times may be of several kinds, because the trajectories lie at the points as ",
        formats::ClocksText(fitting), "; ", OneFlagOf(fitting)));
  }
  if (!is_chosen) {
    found->notes.push_back(absl::StrCat(formats::ClockNote(fitting.front(), file.times, "the trajectory"),
                                        DayText(fitting.front(), file.times, date)));
  }
  (*found->json)["time_format"] = formats::NameOf(fitting.front().format);
  return *std::move(found);
}

}  // namespace albtpu::annotate
