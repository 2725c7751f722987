// The times of the points of a LAS file in UTC, to find the state of the sea at each point.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "formats/trajectories/trajectory_time.h"

namespace albtpu::formats {

// `offset` such that UTC [s since 1970-01-01T00:00:00Z, without leap seconds] = time of a point + offset. Times that
// are seconds of the week leave the week open: it is the one in which the points lie within `known`, an interval of
// UTC. Fails, and names the points' times, where they lie wholly outside `known`, and where seconds of the week fit
// into more than one week of it or start again from 0. `name` begins the message, `of` names the source of `known`:
// "sea.csv".
absl::StatusOr<double> UtcOffset(const std::string& name, const PointTimes& points, const TimeSpan& known,
                                 const std::string& of);

}  // namespace albtpu::formats
