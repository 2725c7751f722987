// The track of the sensor where a survey has no trajectory, from the rays of pairs of returns.
//
// All rays of a recording pass through the sensor. The track is the smooth curve for which the directions from the
// sensor to the water points of the rays agree with the directions of the rays:
//   1. Rays are sorted by time, thinned (ThinRays), and divided at gaps in time into segments, each fitted alone.
//   2. Start: a straight track through a few seconds around each knot (WhereRaysMeet).
//   3. The residual r of a ray is the angle from v = (S - X) / |S - X| to its direction u, as a vector across v. With
//      dv/dX = -Q / |S - X|, Q = I - v v', Gauss-Newton minimizes
//          sum of w |r|^2 + cost of the motion
//      over the states at knots 1.5 s apart (track_spline.h). Directions have the errors, water points hardly any, so
//      angles are unbiased where distances from the lines are not.
//   4. The weights w come from the residuals (RayNoise), the spectral density q of the acceleration from the
//      roughness of the track, by expectation-maximization: a calm flight is smoothed more.
//   5. Waves flatten the mean direction of rays a little; FacingSlopesAt derives the angle from the estimated slopes.
//   6. Posterior. Neighbouring rays meet the same wave, so their errors are not independent. With A = sum of w Q / R^2
//      and the long-run covariance B of the scores w r / R (over lags up to 0.5 s, with Bartlett's weights), the
//      covariance of a position from all rays is A^-1 B A^-1 instead of A^-1. The information of each part of the track
//      is reduced accordingly before the matrix is inverted. What the fit itself took out of the residuals is added to
//      B, and the uncertainty of B itself widens the result where a segment is short.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "budget/beams/return_pair.h"
#include "budget/beams/segment_fit.h"
#include "budget/beams/track_spline.h"

namespace albtpu {

// The estimated state of the sensor, in the frame of the rays.
struct TrackEstimate {
  Eigen::Vector3d position, velocity;  // m, m/s
  Eigen::Matrix3d covariance;          // m^2, of the position.
  double height = 0;                   // m above the water of the segment.
  double incidence_sigma = 0;          // rad; that of a beam of the segment's median incidence, over all azimuths.
};

class RayTrack final : public SensorTrack {
 public:
  RayTrack(std::vector<RaySegment> segments, const RayTrackOptions& options);

  // The estimate inside a segment, however uncertain; none outside.
  std::optional<TrackEstimate> At(double time) const;

  // In the frame of the rays, with a scale of 1 and no convergence.
  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

  std::span<const RaySegment> segments() const { return segments_; }

 private:
  // The standard deviation of the incidence, tabulated; infinite where height or speed are not those of an aircraft.
  struct SigmaTable {
    std::vector<double> sigma;
  };
  const RaySegment* Find(double time) const;
  TrackEstimate EstimateAt(const RaySegment& segment, double time) const;

  std::vector<RaySegment> segments_;
  std::vector<SigmaTable> tables_;
  RayTrackOptions options_;
};

// The track from rays in any order. Segments whose rays do not determine a track are left out.
RayTrack FitTrack(std::span<const AirRay> rays, const RayTrackOptions& options = {});

}  // namespace albtpu
