// The place of a LAS file: its coordinate system, its units, and the local frame in which its points are compared.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/file_track.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::annotate {

struct LasPlace {
  formats::LocalFrame frame;                     // Around the middle of the file.
  std::shared_ptr<const formats::MapFrame> map;  // Null if the coordinate system is not known and need not be.
  std::string remark;                            // For the user, about the coordinate system; may be empty.
};

// Whether points that span these x lie on both sides of 180 degrees of longitude, because no file spans half of the
// earth: then the middle of the span is on its other side.
bool IsSplit(const formats::MapFrame& map, double least_x, double greatest_x);

// The place of a file whose middle is at `middle`; absent: in the middle of the box that the header states, true or
// not, or where the first point is if that lies outside of the box. The vertical unit is that of the plan, or that of
// the coordinate system, or metres. Fails when the coordinate system is in feet without saying whether heights are, and
// when trajectory files need one and there is none.
absl::StatusOr<LasPlace> PlaceOf(const formats::LasReader& reader, const BeamPlan& plan,
                                 std::optional<formats::MapPosition> middle = std::nullopt);

}  // namespace albtpu::annotate
