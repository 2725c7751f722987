// The beams of a LAS file: everything that is determined before its points are annotated.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/file_track.h"
#include "annotate/beams/point_beams.h"
#include "annotate/beams/water_heights.h"
#include "annotate/las/las_chunk.h"
#include "annotate/las/las_place.h"
#include "annotate/las/las_prescan.h"
#include "budget/beams/track_spline.h"
#include "formats/clocks/dated_clock.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::annotate {

class LasBeams {
 public:
  // Reads the file once where surface returns or a trajectory are wanted. `annotation` must outlive the result.
  static absl::StatusOr<std::unique_ptr<LasBeams>> Find(const formats::LasReader& reader,
                                                        const LasAnnotation& annotation);

  // Of each scanner of the annotation, or of the only one.
  const std::vector<BeamGeometry>& geometries() const { return geometries_; }
  const LasPlace& place() const { return place_; }
  // Without planes, unless the annotation wants them.
  LasTerrain terrain() const {
    return {.planes = prescan_.terrain.has_value() ? &*prescan_.terrain : nullptr,
            .is_classified = prescan_.terrain_is_classified,
            .frame = place_.frame};
  }
  bool has_surface_returns() const { return prescan_.surface_returns > 0; }
  // Of the points' times, where the sea goes by time.
  const formats::UtcClock& utc() const { return utc_; }
  // The first and the last record of the sea between which the chosen points lie; where there is a sea.
  const std::pair<std::size_t, std::size_t>& records() const { return records_; }

  const nlohmann::ordered_json& Json() const { return *json_; }
  std::vector<std::string> Notes() const { return notes_; }

 private:
  void NoteLevel();  // Adds a note if most returns from the surface lie far from the level.
  // The clock of the trajectory, where levels or a sea of dates are to be found by the same one.
  void FindClock(const formats::LasReader& reader, const LasAnnotation& annotation);
  absl::Status FindLevels(const formats::LasReader& reader, const BeamPlan& plan);
  absl::Status FindSeas(const formats::LasReader& reader, const SeaTimeline& seas);
  absl::StatusOr<formats::UtcClock> ClockOfSea(const std::string& name, const formats::PointTimes& times,
                                               const std::string& sea, const formats::TimeSpan& known);
  // That the only record of a sea, which nobody chose for its time, is of the time of the points.
  absl::Status CheckOnlyRecord(const formats::LasReader& reader, const SeaTimeline& seas);
  // Place and first pass, again if the points show that the header had put the place elsewhere.
  absl::Status FindPlace(const formats::LasReader& reader, const LasAnnotation& annotation);
  // The track of the sensor at its lever arm, which scanners with equal ones share.
  struct Track {
    std::array<double, 3> lever_arm;
    std::unique_ptr<const SensorTrack> track;
    std::unique_ptr<const SensorMotions> motions;
  };
  absl::Status Scan(const formats::LasReader& reader, const LasAnnotation& annotation);
  // The first pass again where times turned out to be in another unit than it took them in.
  absl::Status TakeUnitOfTime(double seconds, const formats::LasReader& reader, const LasAnnotation& annotation);
  WaterHeights Water(const BeamPlan& plan) const;
  // Null where no point needs a position. `found_seconds`: of a unit of the points' times, as the track says.
  absl::StatusOr<const Track*> FindTrack(const formats::LasReader& reader, const BeamPlan& plan,
                                         const WaterHeights& water, double& found_seconds);
  // By the times of all points; where that fails and a few lie far from all others, by those of the others.
  absl::StatusOr<FileTrack> TrackOf(const TrackedFile& file, const BeamPlan& plan);
  void AddNote(const std::string& note);

  LasPlace place_;
  LasPrescan prescan_;
  std::optional<formats::WaterLevelSeries> levels_;
  std::vector<std::unique_ptr<const Track>> tracks_;
  std::vector<BeamGeometry> geometries_;
  formats::ClockChoice choice_;
  std::vector<formats::ClockReading> readings_;  // Of trajectory, levels and sea, which must be alike.
  formats::UtcClock utc_;
  double seconds_ = 1;  // Of a unit of the points' times.
  std::pair<std::size_t, std::size_t> records_;
  JsonBox json_ = JsonBox::Object();
  std::vector<std::string> notes_;
};

}  // namespace albtpu::annotate
