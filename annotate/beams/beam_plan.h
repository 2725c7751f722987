// How the user describes the beams of a survey (the source of their incidence, their width, the water surface), and the
// motion of the aircraft with its uncertainty that follows from it.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/air/sensor_motion.h"
#include "budget/beams/refracted_path.h"
#include "budget/beams/track_spline.h"
#include "formats/clocks/point_clock.h"
#include "formats/trajectories/sbet_record.h"
#include "formats/trajectories/trajectory_errors.h"
#include "formats/trajectories/trajectory_timeline.h"
#include "formats/trajectories/water_level_file.h"

namespace albtpu::annotate {

// Medians over the part of the trajectory that has points, one standard deviation.
struct TrajectoryPrecision {
  double horizontal = 0, vertical = 0;  // m; horizontal: the root of the sum of squares of north and east.
};

// nullopt where no error file has records at these times. `errors` are of each run.
std::optional<TrajectoryPrecision> PrecisionOf(const std::vector<formats::ErrorsOfRun>& errors,
                                               const formats::TrajectoryTimeline& timeline);

// One incidence for all pulses, as of a cone around the vertical.
struct ConstantIncidence {
  double incidence = 0;                // degree
  std::optional<double> beam_azimuth;  // degree, true
  std::optional<double> altitude;      // m above the water
};

// The scanner swings across the track: the incidence is |scan angle|.
struct AcrossTrackScan {
  std::optional<double> flight_direction;  // degree, true
  std::optional<double> altitude;          // m above the water
};

// The position of the sensor, from the files of its trajectory.
struct TrajectoryFromFiles {
  std::vector<std::string> paths;                                      // Files and folders.
  std::vector<std::string> errors;                                     // Error files of these, and folders of them.
  bool utc = false;                                                    // Times are UTC, not GPS.
  formats::VelocityAxes velocity_axes = formats::VelocityAxes::kAuto;  // Of SBETs.
  std::optional<double> geoid_separation;                              // m
  std::array<double, 3> lever_arm = {};                                // m; forward, right, down
};

// The position of the sensor, from returns under water.
struct TrajectoryFromReturns {};

using BeamSource = std::variant<ConstantIncidence, AcrossTrackScan, TrajectoryFromFiles, TrajectoryFromReturns>;

// The alternatives of BeamSource, as summaries name them in `incidence_from`.
inline constexpr std::array<std::string_view, std::variant_size_v<BeamSource>> kIncidenceSources = {
    "one angle", "scan angle", "trajectory", "returns"};

// Whether beams of this source are known without a water surface.
constexpr bool IsByAngle(std::string_view incidence_from) {
  return incidence_from == kIncidenceSources[0] || incidence_from == kIncidenceSources[1];
}

struct DivergingBeam {
  double divergence = 0;  // mrad, full angle
  double aperture = 0;    // m
};

struct BeamPlan {
  BeamSource source = ConstantIncidence();
  std::variant<float, DivergingBeam> footprint;                  // m, or computed for each pulse.
  formats::TimeFormat time_format = formats::TimeFormat::kAuto;  // Of the points.
  bool any_aircraft = false;                                     // Also compute the motion of the aircraft.
  bool dry_points = false;                                       // Bottom above the water is dry, not without a beam.
  bool any_sea = false;                                          // Not a table of winds: azimuths count from north.
  std::optional<float> azimuth;                                  // degree from downwind, of all beams.
  std::optional<double> wind_from;                               // degree, true
  float wind_speed = 0;                                          // m/s at 10 m
  std::optional<float> fetch;                                    // m; absent: fully developed sea.
  double refractive_index = kSeaWaterIndex;                      // Of the water.

  // The files of TrajectoryFromFiles, opened and checked.
  std::shared_ptr<const formats::TrajectoryFiles> trajectories;
  formats::TrajectoryErrors trajectory_errors;

  // The source of the water surface: at least one of the three.
  std::optional<double> water_level;                              // In the vertical unit and datum of the points.
  std::optional<std::string> water_level_file;                    // Levels by time.
  formats::LevelReference level_reference;                        // Of this file.
  std::shared_ptr<const formats::WaterLevelSeries> water_levels;  // The file, read.
  std::set<int> water_classes;                                    // Of returns from the surface.
  std::optional<std::string> crs;                                 // Of points whose file does not state it.
  std::optional<double> metres_per_unit;  // Of heights; absent: as the coordinate system states.

  bool has_track() const {
    return std::holds_alternative<TrajectoryFromFiles>(source) || std::holds_alternative<TrajectoryFromReturns>(source);
  }
  // Whether distances between points count.
  bool uses_places() const { return has_track() || !water_classes.empty(); }
  // Whether the true direction of each beam is known.
  bool has_direction() const;
};

// The files that the plan reads: trajectories, their errors, water levels.
std::vector<std::string> FilesOf(const BeamPlan& plan);

// The plan as JSON for a summary.
nlohmann::ordered_json Parameters(const BeamPlan& plan);

// The motion of the aircraft, from the files of its trajectory or from a track fitted to the returns.

// Attitude, velocity and rates as the trajectory states them. Where it states no heading, the course; no velocity: that
// of its positions. Standard deviations are those of the error files, or those of the trajectory file itself.
class TrajectoryMotions final : public SensorMotions {
 public:
  // `errors` are of each run.
  TrajectoryMotions(formats::TrajectoryTimeline timeline, std::vector<formats::ErrorsOfRun> errors)
      : timeline_(std::move(timeline)), errors_(std::move(errors)) {}

  std::optional<SensorMotion> At(double time) const override;

 private:
  std::optional<formats::TrajectorySigma> SigmaAt(double time) const;

  formats::TrajectoryTimeline timeline_;
  std::vector<formats::ErrorsOfRun> errors_;
};

// Velocity and course of any track of the sensor; no attitude.
class CourseMotions final : public SensorMotions {
 public:
  // `track` must outlive it.
  explicit CourseMotions(const SensorTrack& track) : track_(track) {}

  std::optional<SensorMotion> At(double time) const override;

 private:
  const SensorTrack& track_;
};

}  // namespace albtpu::annotate
