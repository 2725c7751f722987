// The track of the sensor for the points of one file, in the frame of the file: from trajectory files, compared with
// the rays of pairs of returns, or from these rays alone.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/beams/beam_plan.h"
#include "budget/air/sensor_motion.h"
#include "budget/beams/ray_track.h"
#include "budget/beams/return_pair.h"
#include "budget/beams/track_spline.h"
#include "formats/clocks/point_clock.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/crs/local_frame.h"
#include "formats/crs/map_frame.h"
#include "formats/trajectories/trajectory_checks.h"

namespace albtpu::annotate {

// The inputs of a track.
struct TrackedFile {
  std::string name;  // For messages.
  formats::LocalFrame frame;
  std::shared_ptr<const formats::MapFrame> map;  // May be null where the track comes from the returns.
  formats::PointTimes times;                     // Of the chosen points.
  formats::PointExtent extent;                   // Of the chosen points.
  std::vector<AirRay> rays;                      // In order of time, in the local frame.
  std::uint64_t pairs = 0;                       // Pairs of returns, of which the rays are a sample.
  std::string remark;                            // Why there may be few pairs; may be empty.
};

struct FileTrack {
  std::unique_ptr<const SensorTrack> track;
  std::unique_ptr<const SensorMotions> motions;  // Of the aircraft, along the track.
  formats::PointClock clock;                     // Of the points' times, by which the track lies at them.
  std::optional<double> week;                    // s; adjusted standard GPS time of its beginning, if the clock's times
                                                 // are seconds of one and the trajectory names it.
  JsonBox json;                                  // For a summary.
  std::vector<std::string> notes;                // For the user, a line each.
};

// The file with times as a clock gives them, without rays that have no time.
TrackedFile ByClock(const TrackedFile& stated, const formats::PointClock& clock);

// From the rays, of water of index `index`. Fails when they are too few to determine the position of the sensor.
// `seconds`: of a unit of the points' times.
absl::StatusOr<FileTrack> TrackFromReturns(const TrackedFile& file, double index, double seconds = 1);

// The track that was fitted to the returns of a file, in the coordinates of its points.

class FittedTrack final : public SensorTrack {
 public:
  // `track` is in `frame`.
  FittedTrack(RayTrack track, const formats::LocalFrame& frame) : track_(std::move(track)), frame_(frame) {}

  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

  const RayTrack& track() const { return track_; }

 private:
  RayTrack track_;
  formats::LocalFrame frame_;
};

}  // namespace albtpu::annotate
