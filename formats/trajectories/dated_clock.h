// The clock by which times of points are instants, where what is known has dates: water levels, or records of a sea.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/trajectories/point_clock.h"
#include "formats/trajectories/trajectory_time.h"

namespace albtpu::formats {

// Adjusted standard GPS time = scale * (time as the file of the points states it) + shift.
struct DatedClock {
  PointClock clock;  // Without the week, which `shift` has.
  double scale = 1, shift = 0;

  double operator()(double stated) const { return scale * stated + shift; }
};

// Of the clocks by which half of the points' time or more lies within `known`, adjusted standard GPS times of what `of`
// names: the one that is meant. Times that do not name their week or day have one for each that fits. The clock that
// the header states, or that `format` names, comes before all others, and seconds come before milliseconds. Of several,
// those count that are not later than the creation of the file, and of these the one of that day; a creation before all
// of them says nothing. nullopt where none fits, and where seconds of the week begin again from 0. The error lists
// those that remain where they are several. `note` says what was found unless it is what header or `format` say, and is
// empty then.
absl::StatusOr<std::optional<DatedClock>> FindDatedClock(const PointTimes& points, TimeFormat format,
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

// UtcOffset by the clock that the header states; where it fails, by FindDatedClock. With another `format` than kAuto by
// that alone.
absl::StatusOr<UtcClock> FindUtcClock(const std::string& name, const PointTimes& points, TimeFormat format,
                                      const TimeSpan& known, const std::string& of, std::string& note);

}  // namespace albtpu::formats
