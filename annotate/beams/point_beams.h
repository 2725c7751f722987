// The beam of each point: incidence, azimuth, footprint, slant range and depth, and the pulses with which a table is
// queried.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "annotate/answers/answer_counts.h"
#include "annotate/answers/batch.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/file_track.h"
#include "annotate/beams/water_heights.h"
#include "budget/air/sensor_motion.h"
#include "budget/beams/track_spline.h"
#include "budget/total/budget_columns.h"

namespace albtpu::annotate {

// One element for each point; NaN where there is no number.
struct PointBeams {
  std::vector<std::optional<NoPulse>> why_not;  // Absent: the point has a pulse.
  // 1: the beam met no water before the point, and depth is 0: the point is dry, or of the bottom and above the water.
  std::vector<std::uint8_t> dry;
  std::vector<float> incidence;     // degree, in air, at the water
  std::vector<float> beam_azimuth;  // degree in [0, 360), clockwise from true north
  std::vector<float> azimuth;       // degree from downwind
  std::vector<float> footprint;     // m
  std::vector<float> depth;         // m below the surface; negative above it, 0 of a dry point
  std::vector<float> slant_range;   // m, in air
  // What a total needs beside the beam; empty unless it is wanted.
  std::vector<float> convergence;  // rad; true azimuth = grid azimuth + convergence
  AircraftColumns aircraft;        // Altitude and motion.
  SurfaceCounts surface;
};

// Memory that is reused.
struct BeamScratch {
  std::vector<double> above;  // m, of a dry point above (or, negative, below) the surface that is known there, or 0.
  std::vector<double> heights, east, north, height, depth, convergence;
  std::vector<double> incidence, azimuth, slant_range;
  std::vector<SensorPosition> positions;
  std::vector<TrackOutcome> outcomes;
};

// The direction [degree, true] to which the beam of an across-track scanner points: to the right of the flight
// direction at positive scan angles, to the left at negative ones. At nadir the side does not matter, because both
// sides fold to the same azimuth.
double AcrossTrackAzimuth(double flight_direction, double scan_angle);

// Immutable; any number of threads may use it at a time. What the arguments refer to must outlive it.
class BeamGeometry {
 public:
  // `track` may be null if the plan needs none or there are no points; so may `motions`.
  BeamGeometry(const BeamPlan& plan, const formats::LocalFrame& frame, const WaterHeights& water,
               const SensorTrack* track, const SensorMotions* motions = nullptr)
      : plan_(plan), frame_(frame), water_(water), track_(track), motions_(motions) {}

  // The beams of `points`, each of which depends on its point alone.
  void Compute(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const;

 private:
  void Locate(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const;
  void FromTrack(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const;
  void FromAngles(const SurveyPoints& points, const BeamScratch& scratch, PointBeams& beams) const;
  void FindAircraft(const SurveyPoints& points, const BeamScratch& scratch, PointBeams& beams) const;

  const BeamPlan& plan_;
  formats::LocalFrame frame_;
  WaterHeights water_;
  const SensorTrack* track_;
  const SensorMotions* motions_;
};

// The pulses in water of the points that have one; `rows` says which points these are. A coordinate that is the same
// for all pulses has one number.
void MakePulses(const BeamPlan& plan, const PointBeams& beams, std::vector<std::uint32_t>& rows, PulseBatch& pulses);

}  // namespace albtpu::annotate
