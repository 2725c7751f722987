// The track of the sensor for the points of one file: from trajectory files, compared with the rays of pairs of
// returns, or from these rays alone.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/local_frame.h"
#include "annotate/beams/trajectory_checks.h"
#include "budget/air/sensor_motion.h"
#include "budget/beams/return_pair.h"
#include "budget/beams/sensor_track.h"
#include "formats/crs/map_frame.h"
#include "formats/trajectories/trajectory_time.h"

namespace albtpu::annotate {

// The inputs of a track.
struct TrackedFile {
  std::string name;  // For messages.
  LocalFrame frame;
  std::shared_ptr<const formats::MapFrame> map;  // May be null where the track comes from the returns.
  formats::PointTimes times;                     // Of the chosen points.
  PointExtent extent;                            // Of the chosen points.
  std::vector<AirRay> rays;                      // In order of time, in the local frame.
  std::uint64_t pairs = 0;                       // Pairs of returns, of which the rays are a sample.
  std::string remark;                            // Why there may be few pairs; may be empty.
};

struct FileTrack {
  std::unique_ptr<const SensorTrack> track;
  std::unique_ptr<const SensorMotions> motions;  // Of the aircraft, along the track.
  JsonBox json;                                  // For a summary.
  std::vector<std::string> notes;                // For the user, a line each.
};

// From the trajectory files of the plan that overlap the points in time and lie near them. Fails when they do not, and
// when the rays disagree with the track; the message names the cause as far as it can be found.
absl::StatusOr<FileTrack> TrackFromFiles(const TrackedFile& file, const BeamPlan& plan);

// From the rays, of water of index `index`. Fails when they are too few to determine the position of the sensor.
absl::StatusOr<FileTrack> TrackFromReturns(const TrackedFile& file, double index);

}  // namespace albtpu::annotate
