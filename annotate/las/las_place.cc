#include "annotate/las/las_place.h"

#include <cmath>
#include <optional>

#include "absl/strings/str_cat.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_point_runs.h"
#include "formats/las/las_points.h"

namespace albtpu::annotate {
namespace {

// The coordinate system; null if it is not known.
absl::StatusOr<std::shared_ptr<const formats::MapFrame>> MapOf(const formats::LasReader& reader,
                                                               const BeamPlan& plan) {
  absl::StatusOr<formats::CrsDescription> description = formats::DescribeCrs(reader);
  if (!description.ok()) return description.status();
  bool required = false;
  if (const auto* files = std::get_if<TrajectoryFromFiles>(&plan.source)) {
    description->user = files->crs.value_or("");
    required = true;
  } else if (const auto* returns = std::get_if<TrajectoryFromReturns>(&plan.source)) {
    description->user = returns->crs.value_or("");
    required = returns->crs.has_value();
  }
  if (description->empty() && !required) return nullptr;
  absl::StatusOr<std::shared_ptr<const formats::MapFrame>> map =
      formats::MapFrame::Create(reader.name(), *description);
  if (!map.ok() && !required) return nullptr;
  return map;
}

absl::StatusOr<double> MetresPerHeightUnit(const formats::LasReader& reader, const BeamPlan& plan,
                                           const formats::MapFrame* map) {
  if (plan.metres_per_unit.has_value()) return *plan.metres_per_unit;
  if (map != nullptr && map->metres_per_height_unit().has_value()) return *map->metres_per_height_unit();
  const absl::StatusOr<std::optional<std::string>> feet = formats::FindFeet(reader);
  if (!feet.ok()) return feet.status();
  std::string what = feet->value_or("");
  if (what.empty() && map != nullptr && !map->is_geographic() && map->unit() > 0.3 && map->unit() < 0.31) {
    what = map->crs_name();
  }
  if (what.empty()) return 1.0;
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its coordinate system is in feet (", what,
                   "); give the unit of its heights and of --water-level by --units m, ft or us-ft"));
}

// A point in the middle of the file: of the box that the header states if the first point lies in it, otherwise the
// first point.
absl::StatusOr<formats::MapPosition> MiddleOf(const formats::LasReader& reader) {
  const formats::LasHeader& header = reader.header();
  if (header.point_count == 0) return formats::MapPosition();
  const absl::StatusOr<std::string> record = formats::FirstRecord(reader);
  if (!record.ok()) return record.status();
  const formats::LasPointFields fields(header);
  const formats::MapPosition first = {fields.X(*record), fields.Y(*record)};
  const auto is_inside = [&](double value, std::size_t axis) {
    // The box may be rounded otherwise than the points.
    const double tolerance = 2 * std::abs(header.scale[axis]);
    return header.least[axis] - tolerance <= value && value <= header.greatest[axis] + tolerance;
  };
  if (!is_inside(first.x, 0) || !is_inside(first.y, 1)) return first;
  return formats::MapPosition{(header.least[0] + header.greatest[0]) / 2,
                              (header.least[1] + header.greatest[1]) / 2};
}

// Coordinates that are within the range of longitudes and latitudes, in steps of at most half a metre if they were
// degrees; as metres, no survey has steps of 0.005 mm.
bool LooksGeographic(const formats::LasHeader& header, const formats::MapPosition& middle) {
  constexpr double kLargestStep = 5e-6;
  return std::abs(header.scale[0]) < kLargestStep && std::abs(header.scale[1]) < kLargestStep &&
         std::abs(middle.x) <= 360 && std::abs(middle.y) <= 90;
}

}  // namespace

absl::StatusOr<LasPlace> PlaceOf(const formats::LasReader& reader, const BeamPlan& plan) {
  LasPlace place;
  absl::StatusOr<std::shared_ptr<const formats::MapFrame>> map = MapOf(reader, plan);
  if (!map.ok()) return map.status();
  place.map = *std::move(map);
  const absl::StatusOr<double> metres_per_z = MetresPerHeightUnit(reader, plan, place.map.get());
  if (!metres_per_z.ok()) return metres_per_z.status();
  const absl::StatusOr<formats::MapPosition> middle = MiddleOf(reader);
  if (!middle.ok()) return middle.status();
  // Without a coordinate system, x and y are in the unit of heights.
  place.frame = {.origin_x = middle->x,
                 .origin_y = middle->y,
                 .metres_per_x = *metres_per_z,
                 .metres_per_y = *metres_per_z,
                 .metres_per_z = *metres_per_z};
  if (place.map == nullptr && plan.has_track() && LooksGeographic(reader.header(), *middle)) {
    return absl::InvalidArgumentError(absl::StrCat(
        reader.name(), ": its points seem to be in degrees (x ", middle->x, ", y ", middle->y,
        "), but it states no coordinate system that can be used; name it by --crs, such as --crs EPSG:4326"));
  }
  if (place.map == nullptr) return place;
  place.remark = place.map->remark();
  const std::optional<formats::GeographicPosition> position = place.map->GeographicAt(*middle);
  if (!position.has_value()) {
    if (!plan.has_track()) return place;
    return absl::InvalidArgumentError(
        absl::StrCat(reader.name(), ": its points lie where its coordinate system, ", place.map->crs_name(),
                     ", is not defined (x ", middle->x, ", y ", middle->y, "); give the right one by --crs"));
  }
  const formats::MapMetric metric = place.map->MetricAt(*position);
  place.frame.metres_per_x = metric.metres_per_x;
  place.frame.metres_per_y = metric.metres_per_y;
  return place;
}

}  // namespace albtpu::annotate
