// The track of the sensor for the points of one file, in the frame of the file: from trajectory files, compared with
// the rays of pairs of returns, or from these rays alone.
#pragma once

#include <Eigen/Core>
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
#include "formats/crs/map_frame.h"
#include "formats/trajectories/trajectory_checks.h"
#include "formats/trajectories/trajectory_time.h"

namespace albtpu::annotate {

// A frame in metres around the middle of a file: what the geometry of neighbouring points is computed in.

// x points to grid east, y to grid north, z up in the vertical datum of the points. Horizontal distances are true
// metres at the origin: the scale of a map projection is divided out.
struct LocalFrame {
  double origin_x = 0, origin_y = 0;  // In the horizontal unit of the points.
  double metres_per_x = 1, metres_per_y = 1;
  double metres_per_z = 1;  // Of the vertical unit.
  double north_per_x = 0;   // As of SensorPosition.
  double turn = 0;          // Of longitudes, in which x repeats; 0 on a map.
  // True azimuth = grid azimuth + convergence: rad at the origin, and rad per metre along x and y. It is about
  // (longitude - central meridian) sin(latitude): 15 km from the origin, a straight line leaves 1e-5 rad of it out.
  double convergence = 0;
  Eigen::Vector2d convergence_slope = Eigen::Vector2d::Zero();

  // x - from; of longitudes, the short way round.
  double Difference(double x, double from) const { return turn > 0 ? std::remainder(x - from, turn) : x - from; }

  // m to grid east and grid north of the origin.
  Eigen::Vector2d At(double x, double y) const {
    const double dx = Difference(x, origin_x);
    return {dx * metres_per_x, (y - origin_y) * metres_per_y + dx * north_per_x};
  }
  Eigen::Vector3d At(double x, double y, double z) const { return {At(x, y).x(), At(x, y).y(), Z(z)}; }
  double Z(double z) const { return z * metres_per_z; }

  // The inverse of At; longitudes lie within half a turn of the origin.
  formats::MapPosition MapOf(double east, double north) const {
    const double dx = east / metres_per_x;
    return {origin_x + dx, origin_y + (north - dx * north_per_x) / metres_per_y};
  }

  // rad, at a point in metres from the origin.
  double ConvergenceAt(const Eigen::Vector2d& at) const { return convergence + convergence_slope.dot(at); }
};

// The frame around `middle`, of a file with heights in units of `metres_per_z`. Absent where `map` is not defined.
std::optional<LocalFrame> FrameAround(const formats::MapPosition& middle, const formats::MapFrame& map,
                                      double metres_per_z);

// The inputs of a track.
struct TrackedFile {
  std::string name;  // For messages.
  LocalFrame frame;
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
  double seconds = 1;                            // Of a unit of the points' times.
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
  FittedTrack(RayTrack track, const LocalFrame& frame) : track_(std::move(track)), frame_(frame) {}

  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

  const RayTrack& track() const { return track_; }

 private:
  RayTrack track_;
  LocalFrame frame_;
};

}  // namespace albtpu::annotate
