#include "annotate/las/las_beams.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/beams/trajectory_track.h"
#include "annotate/beams/water_heights.h"
#include "formats/clocks/mixed_clocks.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/las/header_bounds.h"
#include "formats/las/las_points.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

bool GoesByTime(const LasAnnotation& annotation) { return annotation.seas != nullptr && annotation.seas->by_time(); }

// Whether the sea has times, with which those of the points are compared.
bool ComparesTimes(const LasAnnotation& annotation) {
  return GoesByTime(annotation) || (annotation.seas != nullptr && annotation.seas->unchosen_time().has_value());
}

bool UsesTimes(const LasAnnotation& annotation) {
  return annotation.plan.has_track() || annotation.plan.water_levels != nullptr || GoesByTime(annotation);
}

// Without a few that are far from all others.
formats::PointTimes TimesOf(const formats::LasReader& reader, const LasPrescan& prescan) {
  const formats::TimeSpan all = {prescan.first_time, prescan.last_time};
  return formats::PointTimesOf(reader.header(), prescan.tally.Bulk().value_or(all), prescan.numbered);
}

// Times are needed to find the position of the sensor or the water level at a point.
absl::Status CheckTimes(const formats::LasReader& reader, const LasAnnotation& annotation) {
  if (formats::HasGpsTime(reader.header().point_format)) return absl::OkStatus();
  const BeamPlan& plan = annotation.plan;
  if (GoesByTime(annotation)) {
    return absl::FailedPreconditionError(
        absl::StrCat(reader.name(), ": its points have no GPS time (point format ", reader.header().point_format,
                     "), so that no record of the sea can be assigned to them; choose one of them by --sea-time"));
  }
  if (!plan.has_track() && !plan.water_level_file.has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its points have no GPS time (point format ", reader.header().point_format,
                   "), so neither a trajectory nor water levels by time can be used; give --scanner or --incidence and "
                   "one --water-level, or a file of another point format"));
}

absl::Status CheckChannels(const formats::LasReader& reader, const LasAnnotation& annotation) {
  const int format = reader.header().point_format;
  if (format >= formats::kFirstModernFormat) return absl::OkStatus();
  for (const LasChannel& channel : annotation.channels) {
    if (channel.points.channels.empty()) continue;
    return absl::FailedPreconditionError(
        absl::StrCat(reader.name(), ": points of format ", format,
                     " have no scanner channel, by which [[sensor.channel]] tells those of ", channel.label,
                     "; map them by user_data, if they have it, or name one sensor by --sensor"));
  }
  return absl::OkStatus();
}

std::array<double, 3> MetresOf(const LasPlace& place) {
  return {place.frame.metres_per_x, place.frame.metres_per_y, place.frame.metres_per_z};
}

// Without rays.
TrackedFile FileOf(const formats::LasReader& reader, const LasPlace& place, const LasPrescan& prescan) {
  return {.name = reader.name(),
          .frame = place.frame,
          .map = place.map,
          .times = formats::PointTimesOf(reader.header(), {prescan.first_time, prescan.last_time}, prescan.numbered),
          .extent = {.x_min = prescan.of_numbered.least[0],
                     .x_max = prescan.of_numbered.greatest[0],
                     .y_min = prescan.of_numbered.least[1],
                     .y_max = prescan.of_numbered.greatest[1]},
          .rays = {},
          .pairs = prescan.pair_count,
          .remark = prescan.is_scattered()
                        ? absl::StrCat(prescan.alone, " of ", prescan.of_several,
                                       " returns of pulses with several lie alone in the file, whose points "
                                       "are sorted by place or incomplete")
                        : ""};
}

formats::ClockReading ReadingOf(const FileTrack& track) {
  return {.of = "the trajectory",
          .scale = track.clock.scale,
          .shift = track.clock.shift + track.week.value_or(0),
          .form = track.week.has_value() ? formats::PointTimeForm::kAdjustedStandard : track.clock.form};
}

}  // namespace

absl::StatusOr<FileTrack> LasBeams::TrackOf(const TrackedFile& file, const BeamPlan& plan) {
  const auto track_of = [&](const TrackedFile& given) {
    return std::holds_alternative<TrajectoryFromFiles>(plan.source)
               ? TrackFromFiles(given, plan)
               : TrackFromReturns(given, plan.refractive_index, seconds_);
  };
  absl::StatusOr<FileTrack> track = track_of(file);
  const std::optional<formats::TimeSpan> bulk = prescan_.tally.Bulk();
  if (track.ok() || !bulk.has_value()) return track;
  TrackedFile others = file;
  others.times.span = *bulk;
  track = track_of(others);
  if (!track.ok()) return track;
  track->notes.push_back(absl::StrFormat(
      "%d points have GPS times a month or more from those of all others (%g to %g in a file of %.1f "
      "to %.1f): they have no trajectory, like points without a time",
      prescan_.tally.outside_of_bulk(), file.times.span.first, file.times.span.last, bulk->first, bulk->last));
  return track;
}

absl::StatusOr<const LasBeams::Track*> LasBeams::FindTrack(const formats::LasReader& reader, const BeamPlan& plan,
                                                           const WaterHeights& water, double& found_seconds) {
  found_seconds = seconds_;
  if (prescan_.numbered == 0) return nullptr;  // No point needs a position.
  const auto* const files = std::get_if<TrajectoryFromFiles>(&plan.source);
  const std::array<double, 3> lever_arm = files != nullptr ? files->lever_arm : std::array<double, 3>{};
  for (const std::unique_ptr<const Track>& known : tracks_)
    if (known->lever_arm == lever_arm) return known.get();
  TrackedFile file = FileOf(reader, place_, prescan_);
  file.rays = RaysOfPairs(prescan_.pairs, water, place_.frame, plan.refractive_index);
  if (!(file.times.span.first <= file.times.span.last)) {
    return absl::FailedPreconditionError(absl::StrCat(
        reader.name(),
        ": the GPS times of its points are all 0 or no numbers, so that no position of the sensor belongs to them; "
        "take the file as the sensor's software wrote it, or give --scanner or --incidence"));
  }
  ASSIGN_OR_RETURN(FileTrack track, TrackOf(file, plan));
  found_seconds = track.clock.scale;
  ASSIGN_OR_RETURN(const std::string rounded, formats::TimeStepNote(reader.name(), prescan_.tally, found_seconds));
  AddNote(rounded);
  tracks_.emplace_back(new Track{lever_arm, std::move(track.track), std::move(track.motions)});
  if (tracks_.size() > 1) return tracks_.back().get();  // That of another lever arm says nothing else of the file.
  if (files != nullptr) readings_.push_back(ReadingOf(track));
  (*json_)["trajectory"] = std::move(*track.json);
  notes_.insert(notes_.end(), track.notes.begin(), track.notes.end());
  if (prescan_.is_scattered() && prescan_.surface_returns > 0) {
    notes_.push_back(
        "most returns of one pulse do not lie side by side in the file, so that few points have the water "
        "surface of their own pulse; sort the points by GPS time for that");
  }
  return tracks_.back().get();
}

void LasBeams::AddNote(const std::string& note) {
  if (!note.empty() && std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(note);
}

void LasBeams::FindClock(const formats::LasReader& reader, const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  choice_.format = plan.time_format;
  const bool has_dates = (plan.water_levels != nullptr && plan.water_levels->has_dates()) || ComparesTimes(annotation);
  if (!has_dates || !std::holds_alternative<TrajectoryFromFiles>(plan.source) ||
      !(prescan_.first_time <= prescan_.last_time))
    return;
  const absl::StatusOr<FileTrack> track = TrackOf(FileOf(reader, place_, prescan_), plan);
  if (track.ok()) choice_.of_track = track->clock;  // Otherwise FindTrack says why, with the levels.
}

absl::Status LasBeams::FindLevels(const formats::LasReader& reader, const BeamPlan& plan) {
  if (plan.water_levels == nullptr) return absl::OkStatus();
  const formats::PointTimes times = TimesOf(reader, prescan_);
  if (!(times.span.first <= times.span.last)) {  // No point needs a level, or none has a time.
    levels_ = *plan.water_levels;
    return absl::OkStatus();
  }
  std::string note;
  ASSIGN_OR_RETURN(levels_, plan.water_levels->For(times, choice_, note));
  if (std::optional<formats::ClockReading> reading = levels_->ReadingOf(times); reading.has_value())
    readings_.push_back(*std::move(reading));
  levels_->TakeUnit(place_.frame.metres_per_z);
  AddNote(levels_->description());
  AddNote(note);
  return absl::OkStatus();
}

absl::StatusOr<formats::UtcClock> LasBeams::ClockOfSea(const std::string& name, const formats::PointTimes& times,
                                                       const std::string& sea, const formats::TimeSpan& known) {
  std::string note;
  ASSIGN_OR_RETURN(const formats::UtcClock clock, formats::FindUtcClock(name, times, choice_, known, sea, note));
  AddNote(note);
  const double adjusted = formats::GpsOfUtc(clock(times.span.first)) - formats::kAdjustedGpsOffset;
  readings_.push_back({.of = sea, .scale = clock.scale, .shift = adjusted - clock.scale * times.span.first});
  return clock;
}

absl::Status LasBeams::FindSeas(const formats::LasReader& reader, const SeaTimeline& seas) {
  if (!seas.by_time()) {
    records_ = {seas.fixed().first, seas.fixed().second};
    return CheckOnlyRecord(reader, seas);
  }
  if (prescan_.numbered == 0) return absl::OkStatus();  // No point needs a sea.
  ASSIGN_OR_RETURN(
      utc_, ClockOfSea(reader.name(), TimesOf(reader, prescan_), *seas.settings().file, {seas.start(), seas.end()}));
  records_ = seas.RecordsWithin(utc_(prescan_.first_time), utc_(prescan_.last_time));
  return absl::OkStatus();
}

absl::Status LasBeams::CheckOnlyRecord(const formats::LasReader& reader, const SeaTimeline& seas) {
  const std::optional<double> time = seas.unchosen_time();
  if (!time.has_value() || !(prescan_.first_time <= prescan_.last_time)) return absl::OkStatus();
  const formats::TimeSpan near = {*time - seas.longest_gap(), *time + seas.longest_gap()};
  const formats::PointTimes times = formats::Continued(TimesOf(reader, prescan_));
  const absl::StatusOr<formats::UtcClock> utc = ClockOfSea(reader.name(), times, *seas.settings().file, near);
  return utc.ok() && (*utc)(times.span.first) >= near.first && (*utc)(times.span.last) <= near.last
             ? absl::OkStatus()
             : NotOfOnlyRecord(reader.name(), formats::DescribePointTimes(times), seas);
}

void LasBeams::NoteLevel() {
  if (2 * prescan_.off_level <= prescan_.level_returns) return;
  notes_.push_back(
      absl::StrFormat("%d of %d returns from the water surface (by their class) lie more than %g m from "
                      "--water-level, in the mean at "
                      "%.2f; check the level, its unit and its vertical datum, or give --water-classes",
                      prescan_.off_level, prescan_.level_returns, kLevelTolerance,
                      prescan_.off_level_height / place_.frame.metres_per_z));
}

absl::Status LasBeams::Scan(const formats::LasReader& reader, const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  const int format = reader.header().point_format;
  ASSIGN_OR_RETURN(prescan_, Prescan(reader, place_.frame,
                                     {.classes = annotation.ClassesOf(format),
                                      .water_classes = plan.water_classes,
                                      .pairs = plan.has_track(),
                                      .water_level = plan.water_classes.empty() ? plan.water_level : std::nullopt,
                                      .level_classes = formats::UsualSurfaceClasses(format),
                                      .use_withheld = annotation.use_withheld,
                                      .dry_points = plan.dry_points,
                                      .seconds = seconds_,
                                      .terrain = annotation.terrain_slope}));
  return absl::OkStatus();
}

absl::Status LasBeams::TakeUnitOfTime(double seconds, const formats::LasReader& reader,
                                      const LasAnnotation& annotation) {
  if (seconds == seconds_) return absl::OkStatus();
  seconds_ = seconds;
  (*json_)["seconds_per_time_unit"] = seconds;
  return prescan_.surface.has_value() ? Scan(reader, annotation) : absl::OkStatus();
}

absl::Status LasBeams::FindPlace(const formats::LasReader& reader, const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  absl::StatusOr<LasPlace> place = PlaceOf(reader, plan);
  // A wrong box of the header, or a damaged first point, may have put the middle where no map is.
  if (!place.ok() && reader.header().point_count > 0) {
    ASSIGN_OR_RETURN(formats::LasPointRuns runs, formats::LasPointRuns::Open(reader, 0, 0));
    formats::LasRun run;
    RETURN_IF_ERROR(runs.Next(1, run).status());
    const formats::LasPointFields at(reader.header());
    absl::StatusOr<LasPlace> at_first =
        PlaceOf(reader, plan, formats::MapPosition{at.X(run.records), at.Y(run.records)});
    if (at_first.ok()) place = std::move(at_first);
  }
  if (!place.ok()) return place.status();
  place_ = *std::move(place);
  const bool compares_times = ComparesTimes(annotation) && formats::HasGpsTime(reader.header().point_format);
  if (plan.has_track() || !plan.water_classes.empty() || plan.water_level_file.has_value() || compares_times) {
    RETURN_IF_ERROR(Scan(reader, annotation));
    if (const std::string axis = formats::ContradictedAxis(reader.header(), prescan_.all, MetresOf(place_));
        !axis.empty()) {
      return absl::FailedPreconditionError(absl::StrCat(
          reader.name(), ": the bounds in its header are those of its points with another offset or scale of ", axis,
          ", so that one of them is wrong (", formats::WrongBounds(reader.header(), prescan_.all, MetresOf(place_)),
          "); correct the header, or its bounds alone if the points are right"));
    }
    if (const std::string wrong = formats::WrongBounds(reader.header(), prescan_.all, MetresOf(place_));
        !wrong.empty()) {
      notes_.push_back(absl::StrCat("the header states bounds that the points do not have (", wrong,
                                    "); those of the points are used"));
      const std::array<double, 3>&least = prescan_.all.least, &greatest = prescan_.all.greatest;
      formats::MapPosition middle = {(least[0] + greatest[0]) / 2, (least[1] + greatest[1]) / 2};
      if (place_.map != nullptr && IsSplit(*place_.map, least[0], greatest[0])) middle.x = greatest[0];
      ASSIGN_OR_RETURN(place_, PlaceOf(reader, plan, middle));
      RETURN_IF_ERROR(Scan(reader, annotation));
    }
    if (prescan_.synthetic_surface > 0)
      notes_.push_back(absl::StrCat(prescan_.synthetic_surface, " of ", prescan_.surface_returns,
                                    " returns from the water surface are synthetic: no pulse measured them"));
  }
  if (!place_.remark.empty()) notes_.push_back(place_.remark);
  return absl::OkStatus();
}

WaterHeights LasBeams::Water(const BeamPlan& plan) const {
  return {.surface = prescan_.surface.has_value() ? &*prescan_.surface : nullptr,
          .levels = levels_.has_value() ? &*levels_ : nullptr,
          .level = plan.water_level,
          .seconds = seconds_};
}

absl::StatusOr<std::unique_ptr<LasBeams>> LasBeams::Find(const formats::LasReader& reader,
                                                         const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  RETURN_IF_ERROR(CheckTimes(reader, annotation));
  RETURN_IF_ERROR(CheckChannels(reader, annotation));
  std::unique_ptr<LasBeams> beams(new LasBeams());
  if (plan.time_format == formats::TimeFormat::kMilliseconds)
    RETURN_IF_ERROR(beams->TakeUnitOfTime(1e-3, reader, annotation));
  RETURN_IF_ERROR(beams->FindPlace(reader, annotation));
  if (plan.time_format == formats::TimeFormat::kAuto && UsesTimes(annotation))
    RETURN_IF_ERROR(formats::CheckOneClock(reader.name(), beams->prescan_.tally));
  beams->NoteLevel();
  beams->FindClock(reader, annotation);
  if (beams->choice_.of_track.has_value())
    RETURN_IF_ERROR(beams->TakeUnitOfTime(beams->choice_.of_track->scale, reader, annotation));
  RETURN_IF_ERROR(beams->FindLevels(reader, plan));
  if (beams->levels_.has_value() && beams->levels_->seconds() != 1)
    RETURN_IF_ERROR(beams->TakeUnitOfTime(beams->levels_->seconds(), reader, annotation));
  if (annotation.seas != nullptr) RETURN_IF_ERROR(beams->FindSeas(reader, *annotation.seas));
  if (beams->utc_.scale != 1) RETURN_IF_ERROR(beams->TakeUnitOfTime(beams->utc_.scale, reader, annotation));
  const auto add = [&](const BeamPlan& of_scanner) -> absl::Status {
    const Track* track = nullptr;
    if (of_scanner.has_track()) {
      const std::size_t notes = beams->notes_.size();
      double seconds = 1;
      ASSIGN_OR_RETURN(track, beams->FindTrack(reader, of_scanner, beams->Water(plan), seconds));
      if (seconds != beams->seconds_) {  // Of the first track: those of other lever arms have its clock.
        RETURN_IF_ERROR(beams->TakeUnitOfTime(seconds, reader, annotation));
        beams->notes_.resize(notes);
        beams->tracks_.pop_back();
        beams->readings_.pop_back();
        ASSIGN_OR_RETURN(track, beams->FindTrack(reader, of_scanner, beams->Water(plan), seconds));
      }
    }
    beams->geometries_.emplace_back(of_scanner, beams->place_.frame, beams->Water(plan),
                                    track != nullptr ? track->track.get() : nullptr,
                                    track != nullptr ? track->motions.get() : nullptr);
    return absl::OkStatus();
  };
  if (annotation.channels.empty()) RETURN_IF_ERROR(add(plan));
  for (const LasChannel& channel : annotation.channels) RETURN_IF_ERROR(add(channel.plan));
  const formats::PointTimes times = TimesOf(reader, beams->prescan_);
  RETURN_IF_ERROR(formats::CheckReadingsAgree(reader.name(), times, beams->readings_));
  beams->AddNote(formats::CreationNote(times, beams->readings_));
  return beams;
}

}  // namespace albtpu::annotate
