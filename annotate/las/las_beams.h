// The place and the beams of a LAS file: everything that is determined before its points are annotated.
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
#include "annotate/las/las_prescan.h"
#include "budget/beams/track_spline.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::annotate {

// The place of a LAS file: its coordinate system, its units, and the local frame in which its points are compared.

struct LasPlace {
  LocalFrame frame;                              // Around the middle of the file.
  std::shared_ptr<const formats::MapFrame> map;  // Null if the coordinate system is not known and need not be.
  std::string remark;                            // For the user, about the coordinate system; may be empty.
};

// The vertical unit is that of the plan, or that of the coordinate system, or metres. Fails when the coordinate system
// is in feet without saying whether heights are, and when trajectory files need one and there is none.
absl::StatusOr<LasPlace> PlaceOf(const formats::LasReader& reader, const BeamPlan& plan);

class LasBeams {
 public:
  // Reads the file once where surface returns or a trajectory are wanted. `annotation` must outlive the result.
  static absl::StatusOr<std::unique_ptr<LasBeams>> Find(const formats::LasReader& reader,
                                                        const LasAnnotation& annotation);

  const BeamGeometry& geometry() const { return *geometry_; }
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
