// The clock by which times of points are instants, where what is known has dates: water levels, or records of a sea.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "formats/clocks/point_clock.h"
#include "formats/clocks/trajectory_time.h"

namespace albtpu::formats {

// Adjusted standard GPS time = scale * (time as the file of the points states it) + shift.
struct DatedClock {
  PointClock clock;  // Without the week, which `shift` has.
  double scale = 1, shift = 0;

  double operator()(double stated) const { return scale * stated + shift; }
};

// What is known of the clock before dates are.
struct ClockChoice {
  TimeFormat format = TimeFormat::kAuto;  // As the user names it.
  std::optional<PointClock> of_track =
      std::nullopt;  // By which the trajectory lies at the points: no other one counts.

  bool is_open() const { return format == TimeFormat::kAuto && !of_track.has_value(); }
  // Whether it may be that of the header.
  bool keeps_header() const { return is_open() || (of_track.has_value() && of_track->format == TimeFormat::kAuto); }
};

// "--time-format day is right", "the times are seconds of the day, a Wednesday, as the trajectory has them"
std::string ChoiceText(const ClockChoice& choice, const PointTimes& points);

// Seconds of the week that start again from 0 where the next one begins become those that continue beyond its end.
PointTimes Continued(PointTimes points);

// Of the clocks by which half of the points' time or more lies within `known`, adjusted standard GPS times of what `of`
// names: the one that is meant. Times that do not name their week or day have one for each that fits. The clock that
// the header states, or that the user names, comes before all others, and seconds come before milliseconds; where it is
// plausible (IsHeaderPlausible), no other one counts unless the trajectory has it, and neither do milliseconds of what
// may be seconds of the week, of which a thousandth is a time of any day. Seconds of a day of more than 18 hours
// begin again at midnight, and have no date. Of several, those count that are not later than the creation of the file,
// and of these the one of that day; a creation before all of them says nothing. nullopt where none fits, and where
// seconds of the week begin again from 0. The error lists those that remain where they are several. `note` says what
// was found unless it is what header, user or trajectory say, and is empty then.
absl::StatusOr<std::optional<DatedClock>> FindDatedClock(const PointTimes& points, const ClockChoice& choice,
                                                         const TimeSpan& known, const std::string& of,
                                                         std::string& note);

// The times of the points of a LAS file in UTC, to find the state of the sea at each point.
//
// `offset` such that UTC [s since 1970-01-01T00:00:00Z, without leap seconds] = time of a point + offset. Times that
// are seconds of the week leave the week open: it is the one in which the points lie within `known`, an interval of
// UTC. Fails, and names the points' times, where they lie wholly outside `known`, and where seconds of the week fit
// into more than one week of it or start again from 0. `name` begins the message, `of` names the source of `known`:
// "sea.csv".
absl::StatusOr<double> UtcOffset(const std::string& name, const PointTimes& points, const TimeSpan& known,
                                 const std::string& of);

// UTC [s since 1970, without leap seconds] = scale * (time as the file of the points states it) + shift.
struct UtcClock {
  double scale = 1, shift = 0;

  double operator()(double stated) const { return scale * stated + shift; }
};

// UtcOffset by the clock that the header states; where it fails, by FindDatedClock. With a choice by that alone.
absl::StatusOr<UtcClock> FindUtcClock(const std::string& name, const PointTimes& points, const ClockChoice& choice,
                                      const TimeSpan& known, const std::string& of, std::string& note);

// How a source of data by time reads the times of the points: time = scale * (time as their file states it) + shift.
struct ClockReading {
  std::string of;  // "levels.csv", "the trajectory"
  double scale = 1, shift = 0;
  PointTimeForm form = PointTimeForm::kAdjustedStandard;  // Of the time that results.

  double operator()(double stated) const { return scale * stated + shift; }
};

// Fails where two sources put the first point of a file at different instants, of days or weeks as far as they name
// them: then one of them belongs to another day. `name`: of the file.
absl::Status CheckReadingsAgree(const std::string& name, const PointTimes& points,
                                std::span<const ClockReading> readings);

// For the user, where by one of the sources the points were measured after their file was created. Else empty.
std::string CreationNote(const PointTimes& points, std::span<const ClockReading> readings);

}  // namespace albtpu::formats
