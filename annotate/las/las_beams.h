// The beams of a LAS file: everything that is determined before its points are annotated.
#pragma once

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
#include "annotate/las/las_chunk.h"
#include "annotate/las/las_place.h"
#include "annotate/las/las_prescan.h"
#include "budget/beams/track_spline.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::annotate {

class LasBeams {
 public:
  // Reads the file once where surface returns or a trajectory are wanted. `annotation` must outlive the result.
  static absl::StatusOr<std::unique_ptr<LasBeams>> Find(const formats::LasReader& reader,
                                                        const LasAnnotation& annotation);

  const BeamGeometry& geometry() const { return *geometry_; }
  // Without planes, unless the annotation wants them.
  LasTerrain terrain() const {
    return {.planes = prescan_.terrain.has_value() ? &*prescan_.terrain : nullptr,
            .is_classified = prescan_.terrain_is_classified,
            .frame = place_.frame};
  }
  bool has_surface_returns() const { return prescan_.surface_returns > 0; }
  // UTC [s since 1970] = time of a point + it; where the sea goes by time.
  double utc() const { return utc_; }
  // The first and the last record of the sea between which the chosen points lie; where there is a sea.
  const std::pair<std::size_t, std::size_t>& records() const { return records_; }

  const nlohmann::ordered_json& Json() const { return *json_; }
  std::vector<std::string> Notes() const { return notes_; }

 private:
  void NoteLevel();  // Adds a note if most returns from the surface lie far from the level.
  absl::Status FindSeas(const formats::LasReader& reader, const SeaTimeline& seas);
  // Place and first pass, again if the points show that the header had put the place elsewhere.
  absl::Status FindPlace(const formats::LasReader& reader, const LasAnnotation& annotation);
  absl::Status FindTrack(const formats::LasReader& reader, const BeamPlan& plan, const WaterHeights& water);

  LasPlace place_;
  LasPrescan prescan_;
  std::optional<formats::WaterLevelSeries> levels_;
  std::unique_ptr<const SensorTrack> track_;
  std::unique_ptr<const SensorMotions> motions_;
  std::optional<BeamGeometry> geometry_;
  double utc_ = 0;
  std::pair<std::size_t, std::size_t> records_;
  JsonBox json_ = JsonBox::Object();
  std::vector<std::string> notes_;
};

}  // namespace albtpu::annotate
