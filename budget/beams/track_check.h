// Checks whether a given trajectory agrees with the rays of pairs of returns and, if not, finds the likely mistake.
//
// The beams of a correct trajectory follow the rays: the mean signed difference of incidence is about 0.001 degree over
// flat water and below 0.15 degree over waves, whatever the spread of single rays. A wrong trajectory is displaced, and
// the displacement that fits the rays shows the cause as far as geometry allows:
//   * a shift in time puts the sensor elsewhere along its own track;
//   * a height is off by a constant (geoid separation) or by the ratio of feet and metres;
//   * a lever arm displaces in the axes of the aircraft. Forward by less than 10 m is a lever arm, farther a time;
//   * a rotation in the horizontal (convergence, datum) displaces the ends of a line to opposite sides;
//   * a track that no displacement of up to 100 m brings near the rays is of another flight, zone or datum.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>

#include "budget/beams/displacement_fit.h"
#include "budget/beams/refracted_path.h"
#include "budget/beams/return_pair.h"

namespace albtpu {

enum class TrackVerdict {
  kAgrees,
  kTooFewRays,  // Too few rays at times of the track, or too uncertain ones for a verdict.
  kTimeOffset,
  kHeightOffset,
  kHeightUnit,        // Heights in feet where metres are expected, or the reverse.
  kHorizontalOffset,  // In the axes of the aircraft: a lever arm.
  kRotation,
  kUnrelated,  // Another flight, another zone or datum.
};

struct TrackCheckOptions {
  double limit = 0.3 * std::numbers::pi / 180;  // rad; differences of incidence up to it agree.
  double significance = 4;                      // Of a normal error; a smaller difference is chance.
  std::size_t min_rays = 30;
  std::size_t max_rays = 20000;     // More are thinned evenly in time.
  double longest_time_offset = 20;  // s
  double index = kSeaWaterIndex;
};

// The correction of a parameter by the rays: `value` must be added to the track for it to agree with them.
struct Correction {
  double value = 0, sigma = 0;
  int freedom = 1;  // Degrees of freedom of sigma.
};

struct TrackCheck {
  TrackVerdict verdict = TrackVerdict::kTooFewRays;
  std::size_t rays = 0;         // Used.
  double median_incidence = 0;  // rad, by the track.
  // Track minus rays [rad]: the component of their angle in the vertical plane of the track's beam, of the rays that
  // are no outliers; what waves do to rays in the mean is taken out.
  Correction mean_difference;
  double rms_difference = 0;
  double range = 0;                // m; median distance of the sensor from the water points, by the rays.
  double median_angle = 0;         // rad, between rays and directions from the track as it is,
  double angle_with_offset = 0;    // with the offset below,
  double angle_with_time = 0;      // with the time offset,
  double angle_with_rotation = 0;  // with offset and rotation.
  Correction forward, right, up;   // m
  Correction time;                 // s; the track at t + time agrees with rays at t.
  double up_with_time = 0;         // m; the height offset that remains with the time offset.
  Correction rotation;             // rad, about the vertical, to the left.
  double height_ratio = 1;         // True heights over given ones, both in the datum of the points.
  double distance = 0;             // m; median distance of the track's positions from the lines of the rays.
};

// Compares the track with the rays. Both are in one local frame in metres whose heights are those of the points' datum
// (not shifted: the ratio of feet is one of heights). Rays come in any order.
TrackCheck CheckTrack(std::span<const AirRay> rays, const TrackPositions& track, const TrackCheckOptions& options = {});

// True for all verdicts that contradict the track.
bool Disagrees(TrackVerdict verdict);

// The finding in one sentence: what differs, by how much, and the likely cause.
std::string Describe(const TrackCheck& check);

}  // namespace albtpu
