#include "annotate/las/las_place.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_points.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// The coordinate system; without a map if it is not known and need not be.
absl::StatusOr<formats::LasCrs> CrsFor(const formats::LasReader& reader, const BeamPlan& plan,
                                       const formats::MapPosition& middle) {
  const bool required = plan.crs.has_value() || std::holds_alternative<TrajectoryFromFiles>(plan.source);
  absl::StatusOr<formats::LasCrs> crs = formats::CrsOf(reader, plan.crs.value_or(""), middle);
  if (crs.ok() || required) return crs;
  formats::LasCrs unknown;
  ASSIGN_OR_RETURN(unknown.feet, formats::FindFeet(reader));
  return unknown;
}

absl::StatusOr<double> MetresPerHeightUnit(const formats::LasReader& reader, const BeamPlan& plan,
                                           const formats::LasCrs& crs) {
  if (plan.metres_per_unit.has_value()) return *plan.metres_per_unit;
  if (crs.metres_per_height_unit.has_value()) return *crs.metres_per_height_unit;
  std::string what = crs.feet.value_or("");
  const formats::MapFrame* const map = crs.map.get();
  if (what.empty() && map != nullptr && !map->is_geographic() && map->unit() > 0.3 && map->unit() < 0.31)
    what = map->crs_name();
  if (what.empty()) return 1.0;
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its coordinate system is in feet (", what,
                   "); give the unit of its heights and of --water-level by --units m, ft or us-ft"));
}

// Coordinates that are within the range of longitudes and latitudes, in steps of at most half a metre if they were
// degrees; as metres, no survey has steps of 0.005 mm.
bool LooksGeographic(const formats::LasHeader& header, const formats::MapPosition& middle) {
  constexpr double kLargestStep = 5e-6;
  return std::abs(header.scale[0]) < kLargestStep && std::abs(header.scale[1]) < kLargestStep &&
         std::abs(middle.x) <= 360 && std::abs(middle.y) <= 90;
}

// The middle of the box of the header, unless the first point lies outside.
absl::StatusOr<formats::MapPosition> StatedMiddle(const formats::LasReader& reader) {
  const formats::LasHeader& header = reader.header();
  if (header.point_count == 0) return formats::MapPosition();
  ASSIGN_OR_RETURN(const std::string record, formats::FirstRecord(reader));
  const formats::LasPointFields fields(header);
  const formats::MapPosition first = {fields.X(record), fields.Y(record)};
  const auto is_inside = [&](double value, std::size_t axis) {
    // The box may be rounded otherwise than the points.
    const double tolerance = 2 * std::abs(header.scale[axis]);
    return header.least[axis] - tolerance <= value && value <= header.greatest[axis] + tolerance;
  };
  if (!is_inside(first.x, 0) || !is_inside(first.y, 1)) return first;
  return formats::MapPosition{(header.least[0] + header.greatest[0]) / 2, (header.least[1] + header.greatest[1]) / 2};
}

}  // namespace

bool IsSplit(const formats::MapFrame& map, double least_x, double greatest_x) {
  return map.turn() > 0 && greatest_x - least_x > map.turn() / 2;
}

absl::StatusOr<LasPlace> PlaceOf(const formats::LasReader& reader, const BeamPlan& plan,
                                 std::optional<formats::MapPosition> given) {
  formats::MapPosition middle;
  if (given.has_value()) {
    middle = *given;
  } else {
    ASSIGN_OR_RETURN(middle, StatedMiddle(reader));
  }
  LasPlace place;
  ASSIGN_OR_RETURN(const formats::LasCrs crs, CrsFor(reader, plan, middle));
  ASSIGN_OR_RETURN(const double metres_per_z, MetresPerHeightUnit(reader, plan, crs));
  place.map = crs.map;
  // Without a coordinate system, x and y are in the unit of heights.
  place.frame = {.origin_x = middle.x,
                 .origin_y = middle.y,
                 .metres_per_x = metres_per_z,
                 .metres_per_y = metres_per_z,
                 .metres_per_z = metres_per_z};
  if (place.map == nullptr && plan.uses_places() && LooksGeographic(reader.header(), middle)) {
    return absl::InvalidArgumentError(absl::StrCat(
        reader.name(), ": its points seem to be in degrees (x ", middle.x, ", y ", middle.y,
        "), but it states no coordinate system that can be used; name it by --crs, such as --crs EPSG:4326"));
  }
  if (place.map == nullptr) return place;
  place.remark = crs.remark;
  const formats::LasHeader& header = reader.header();
  if (!given.has_value() && header.point_count > 0 && IsSplit(*place.map, header.least[0], header.greatest[0])) {
    ASSIGN_OR_RETURN(const std::string record, formats::FirstRecord(reader));
    middle.x = formats::LasPointFields(header).X(record);
  }
  const std::optional<formats::LocalFrame> frame = formats::FrameAround(middle, *place.map, metres_per_z);
  if (!frame.has_value()) {
    if (!plan.has_track()) return place;
    return absl::InvalidArgumentError(absl::StrCat(reader.name(), ": its points lie where its coordinate system, ",
                                                   place.map->crs_name(), ", is not defined (x ", middle.x, ", y ",
                                                   middle.y, "); give the right one by --crs"));
  }
  place.frame = *frame;
  return place;
}

}  // namespace albtpu::annotate
