#include "annotate/las/las_beams.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/beams/water_heights.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_points.h"
#include "formats/trajectories/trajectory_time.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// The coordinate system; null if it is not known.
absl::StatusOr<std::shared_ptr<const formats::MapFrame>> MapOf(const formats::LasReader& reader, const BeamPlan& plan) {
  ASSIGN_OR_RETURN(formats::CrsDescription description, formats::DescribeCrs(reader));
  bool required = false;
  if (const auto* files = std::get_if<TrajectoryFromFiles>(&plan.source)) {
    description.user = files->crs.value_or("");
    required = true;
  } else if (const auto* returns = std::get_if<TrajectoryFromReturns>(&plan.source)) {
    description.user = returns->crs.value_or("");
    required = returns->crs.has_value();
  }
  if (description.empty() && !required) return nullptr;
  absl::StatusOr<std::shared_ptr<const formats::MapFrame>> map = formats::MapFrame::Create(reader.name(), description);
  if (!map.ok() && !required) return nullptr;
  return map;
}

absl::StatusOr<double> MetresPerHeightUnit(const formats::LasReader& reader, const BeamPlan& plan,
                                           const formats::MapFrame* map) {
  if (plan.metres_per_unit.has_value()) return *plan.metres_per_unit;
  if (map != nullptr && map->metres_per_height_unit().has_value()) return *map->metres_per_height_unit();
  ASSIGN_OR_RETURN(const std::optional<std::string> feet, formats::FindFeet(reader));
  std::string what = feet.value_or("");
  if (what.empty() && map != nullptr && !map->is_geographic() && map->unit() > 0.3 && map->unit() < 0.31)
    what = map->crs_name();
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
  ASSIGN_OR_RETURN(place.map, MapOf(reader, plan));
  ASSIGN_OR_RETURN(const double metres_per_z, MetresPerHeightUnit(reader, plan, place.map.get()));
  ASSIGN_OR_RETURN(const formats::MapPosition middle, MiddleOf(reader));
  // Without a coordinate system, x and y are in the unit of heights.
  place.frame = {.origin_x = middle.x,
                 .origin_y = middle.y,
                 .metres_per_x = metres_per_z,
                 .metres_per_y = metres_per_z,
                 .metres_per_z = metres_per_z};
  if (place.map == nullptr && plan.has_track() && LooksGeographic(reader.header(), middle)) {
    return absl::InvalidArgumentError(absl::StrCat(
        reader.name(), ": its points seem to be in degrees (x ", middle.x, ", y ", middle.y,
        "), but it states no coordinate system that can be used; name it by --crs, such as --crs EPSG:4326"));
  }
  if (place.map == nullptr) return place;
  place.remark = place.map->remark();
  const std::optional<formats::GeographicPosition> position = place.map->GeographicAt(middle);
  if (!position.has_value()) {
    if (!plan.has_track()) return place;
    return absl::InvalidArgumentError(absl::StrCat(reader.name(), ": its points lie where its coordinate system, ",
                                                   place.map->crs_name(), ", is not defined (x ", middle.x, ", y ",
                                                   middle.y, "); give the right one by --crs"));
  }
  const formats::MapMetric metric = place.map->MetricAt(*position);
  place.frame.metres_per_x = metric.metres_per_x;
  place.frame.metres_per_y = metric.metres_per_y;
  return place;
}

namespace {

bool GoesByTime(const LasAnnotation& annotation) { return annotation.seas != nullptr && annotation.seas->by_time(); }

formats::PointTimes TimesOf(const formats::LasReader& reader, const LasPrescan& prescan) {
  return {.span = {prescan.first_time, prescan.last_time},
          .form = reader.header().adjusted_gps_time ? formats::PointTimeForm::kAdjustedStandard
                                                    : formats::PointTimeForm::kWeekSeconds};
}

// Times are needed to find the position of the sensor or the water level at a point.
absl::Status CheckTimes(const formats::LasReader& reader, const LasAnnotation& annotation) {
  if (formats::HasGpsTime(reader.header().point_format)) return absl::OkStatus();
  const BeamPlan& plan = annotation.plan;
  if (GoesByTime(annotation)) {
    return absl::FailedPreconditionError(
        absl::StrCat(reader.name(), ": its points have no GPS time (point format ", reader.header().point_format,
                     "), so that no record of the sea can be assigned to them; choose one of them by --sea-time"));
  }
  if (!plan.has_track() && !plan.water_level_file.has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its points have no GPS time (point format ", reader.header().point_format,
                   "), so neither a trajectory nor water levels by time can be used; give --scanner or --incidence and "
                   "one --water-level, or a file of another point format"));
}

TrackedFile FileOf(const formats::LasReader& reader, const LasPlace& place, const LasPrescan& prescan,
                   const WaterHeights& water, double index) {
  return {.name = reader.name(),
          .frame = place.frame,
          .map = place.map,
          .times = TimesOf(reader, prescan),
          .extent = {.x_min = prescan.least[0],
                     .x_max = prescan.greatest[0],
                     .y_min = prescan.least[1],
                     .y_max = prescan.greatest[1]},
          .rays = RaysOfPairs(prescan.pairs, water, place.frame, index),
          .pairs = prescan.pair_count,
          .remark = prescan.is_scattered()
                        ? absl::StrCat(prescan.alone, " of ", prescan.of_several,
                                       " returns of pulses with several lie alone in the file, whose points "
                                       "are sorted by place or incomplete")
                        : ""};
}

}  // namespace

absl::Status LasBeams::FindTrack(const formats::LasReader& reader, const BeamPlan& plan, const WaterHeights& water) {
  if (prescan_.chosen == 0) return absl::OkStatus();  // No point needs a position.
  const TrackedFile file = FileOf(reader, place_, prescan_, water, plan.refractive_index);
  const bool all_zero = file.times.span.first == 0 && file.times.span.last == 0;
  if (all_zero || !(file.times.span.first <= file.times.span.last)) {
    return absl::FailedPreconditionError(
        absl::StrCat(reader.name(), ": the GPS times of its points are all ", all_zero ? "0" : "no numbers",
                     ", so that no position of the sensor belongs to them; "
                     "take the file as the sensor's software wrote it, or give --scanner or --incidence"));
  }
  ASSIGN_OR_RETURN(FileTrack track, std::holds_alternative<TrajectoryFromFiles>(plan.source)
                                        ? TrackFromFiles(file, plan)
                                        : TrackFromReturns(file, plan.refractive_index));
  track_ = std::move(track.track);
  motions_ = std::move(track.motions);
  (*json_)["trajectory"] = std::move(*track.json);
  notes_.insert(notes_.end(), track.notes.begin(), track.notes.end());
  if (prescan_.is_scattered() && prescan_.surface_returns > 0) {
    notes_.push_back(
        "most returns of one pulse do not lie side by side in the file, so that few points have the water "
        "surface of their own pulse; sort the points by GPS time for that");
  }
  return absl::OkStatus();
}

absl::Status LasBeams::FindSeas(const formats::LasReader& reader, const SeaTimeline& seas) {
  if (!seas.by_time()) {
    records_ = {seas.fixed().first, seas.fixed().second};
    return absl::OkStatus();
  }
  if (prescan_.chosen == 0) return absl::OkStatus();  // No point needs a sea.
  ASSIGN_OR_RETURN(utc_, formats::UtcOffset(reader.name(), TimesOf(reader, prescan_), {seas.start(), seas.end()},
                                            *seas.settings().file));
  records_ = seas.RecordsWithin(prescan_.first_time + utc_, prescan_.last_time + utc_);
  return absl::OkStatus();
}

void LasBeams::NoteLevel() {
  if (2 * prescan_.off_level <= prescan_.level_returns) return;
  notes_.push_back(
      absl::StrFormat("%d of %d returns from the water surface (by their class) lie more than %g m from "
                      "--water-level, in the mean at "
                      "%.2f; check the level, its unit and its vertical datum, or give --water-classes",
                      prescan_.off_level, prescan_.level_returns, kLevelTolerance,
                      prescan_.off_level_height / place_.frame.metres_per_z));
}

absl::StatusOr<std::unique_ptr<LasBeams>> LasBeams::Find(const formats::LasReader& reader,
                                                         const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  RETURN_IF_ERROR(CheckTimes(reader, annotation));
  std::unique_ptr<LasBeams> beams(new LasBeams());
  ASSIGN_OR_RETURN(beams->place_, PlaceOf(reader, plan));
  if (plan.has_track() && !beams->place_.remark.empty()) beams->notes_.push_back(beams->place_.remark);
  if (plan.water_level_file.has_value()) {
    ASSIGN_OR_RETURN(beams->levels_,
                     formats::ReadWaterLevels(*plan.water_level_file, reader.header().adjusted_gps_time
                                                                          ? formats::PointTimeForm::kAdjustedStandard
                                                                          : formats::PointTimeForm::kWeekSeconds));
  }
  if (plan.has_track() || !plan.water_classes.empty() || GoesByTime(annotation)) {
    ASSIGN_OR_RETURN(beams->prescan_,
                     Prescan(reader, beams->place_.frame,
                             {.classes = annotation.ClassesOf(reader.header().point_format),
                              .water_classes = plan.water_classes,
                              .pairs = plan.has_track(),
                              .water_level = plan.water_classes.empty() ? plan.water_level : std::nullopt,
                              .level_classes = formats::UsualSurfaceClasses(reader.header().point_format)}));
    beams->NoteLevel();
  }
  if (annotation.seas != nullptr) RETURN_IF_ERROR(beams->FindSeas(reader, *annotation.seas));
  const WaterHeights water = {.surface = beams->prescan_.surface.has_value() ? &*beams->prescan_.surface : nullptr,
                              .levels = beams->levels_.has_value() ? &*beams->levels_ : nullptr,
                              .level = plan.water_level};
  if (plan.has_track()) RETURN_IF_ERROR(beams->FindTrack(reader, plan, water));
  beams->geometry_.emplace(plan, beams->place_.frame, water, beams->track_.get(), beams->motions_.get());
  return beams;
}

}  // namespace albtpu::annotate
