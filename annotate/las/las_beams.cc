#include "annotate/las/las_beams.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/beams/water_heights.h"
#include "formats/las/las_points.h"
#include "formats/trajectories/trajectory_time.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
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

constexpr double kRoundedBounds = 1;  // m; programs round the bounds of a header.

// "x 0 to 8 instead of 3 to 8": the bounds of the header that are not those of the points. Empty without points.
std::string WrongBounds(const formats::LasHeader& header, const LasPrescan::Box& box, const LocalFrame& frame) {
  const std::array<double, 3> metres = {frame.metres_per_x, frame.metres_per_y, frame.metres_per_z};
  std::string wrong;
  for (std::size_t axis = 0; axis < metres.size() && header.point_count > 0; ++axis) {
    const auto is_off = [&](double stated, double found) {
      return !(std::abs(stated - found) * metres[axis] <= kRoundedBounds);
    };
    if (!is_off(header.least[axis], box.least[axis]) && !is_off(header.greatest[axis], box.greatest[axis])) continue;
    absl::StrAppendFormat(&wrong, "%s%c %.10g to %.10g instead of %.10g to %.10g", wrong.empty() ? "" : ", ",
                          "xyz"[axis], header.least[axis], header.greatest[axis], box.least[axis], box.greatest[axis]);
  }
  return wrong;
}

// "x": the axis whose bounds are those of the points with another offset or another scale, so that one of the three is
// wrong, and nothing says which. Empty if there is none.
std::string ContradictedAxis(const formats::LasHeader& header, const LasPrescan::Box& box, const LocalFrame& frame) {
  const std::array<double, 3> metres = {frame.metres_per_x, frame.metres_per_y, frame.metres_per_z};
  for (std::size_t axis = 0; axis < metres.size() && header.point_count > 0; ++axis) {
    const double least = header.least[axis] - header.offset[axis], found_least = box.least[axis] - header.offset[axis];
    const double greatest = header.greatest[axis] - header.offset[axis];
    const double found_greatest = box.greatest[axis] - header.offset[axis];
    const double step = 4 * std::abs(header.scale[axis]);
    if (!(std::abs(least - found_least) * metres[axis] > kRoundedBounds)) continue;
    if (!(std::abs(greatest - found_greatest) * metres[axis] > kRoundedBounds)) continue;
    const bool shifted = std::abs((least - found_least) - (greatest - found_greatest)) <= step;
    // With a negative factor, the greatest is that of the least; a factor of 1 would exchange the two alone.
    const auto scaled = [&](double first, double second) {
      const double factor = first / found_least;
      return factor != 0 && std::abs(factor - 1) > 1e-9 &&
             std::abs(factor * found_greatest - second) <= step * std::max(1.0, std::abs(factor));
    };
    if (shifted || scaled(least, greatest) || scaled(greatest, least)) return std::string(1, "xyz"[axis]);
  }
  return "";
}

TrackedFile FileOf(const formats::LasReader& reader, const LasPlace& place, const LasPrescan& prescan,
                   const WaterHeights& water, double index) {
  return {.name = reader.name(),
          .frame = place.frame,
          .map = place.map,
          .times = TimesOf(reader, prescan),
          .extent = {.x_min = prescan.of_numbered.least[0],
                     .x_max = prescan.of_numbered.greatest[0],
                     .y_min = prescan.of_numbered.least[1],
                     .y_max = prescan.of_numbered.greatest[1]},
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
  if (prescan_.numbered == 0) return absl::OkStatus();  // No point needs a position.
  const TrackedFile file = FileOf(reader, place_, prescan_, water, plan.refractive_index);
  if (!(file.times.span.first <= file.times.span.last)) {
    return absl::FailedPreconditionError(absl::StrCat(
        reader.name(),
        ": the GPS times of its points are all 0 or no numbers, so that no position of the sensor belongs to them; "
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
  if (prescan_.numbered == 0) return absl::OkStatus();  // No point needs a sea.
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

absl::Status LasBeams::FindPlace(const formats::LasReader& reader, const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  absl::StatusOr<LasPlace> place = PlaceOf(reader, plan);
  // A wrong box of the header may have put the middle where no map is.
  if (!place.ok() && reader.header().point_count > 0) {
    ASSIGN_OR_RETURN(const std::string first, formats::FirstRecord(reader));
    const formats::LasPointFields fields(reader.header());
    absl::StatusOr<LasPlace> at_first = PlaceOf(reader, plan, formats::MapPosition{fields.X(first), fields.Y(first)});
    if (at_first.ok()) place = std::move(at_first);
  }
  if (!place.ok()) return place.status();
  place_ = *std::move(place);
  const int format = reader.header().point_format;
  const auto scan = [&]() -> absl::Status {
    ASSIGN_OR_RETURN(prescan_, Prescan(reader, place_.frame,
                                       {.classes = annotation.ClassesOf(format),
                                        .water_classes = plan.water_classes,
                                        .pairs = plan.has_track(),
                                        .water_level = plan.water_classes.empty() ? plan.water_level : std::nullopt,
                                        .level_classes = formats::UsualSurfaceClasses(format),
                                        .use_withheld = annotation.use_withheld,
                                        .dry_points = plan.dry_points,
                                        .terrain = annotation.terrain_slope}));
    return absl::OkStatus();
  };
  if (plan.has_track() || !plan.water_classes.empty() || GoesByTime(annotation)) {
    RETURN_IF_ERROR(scan());
    if (const std::string axis = ContradictedAxis(reader.header(), prescan_.all, place_.frame); !axis.empty()) {
      return absl::FailedPreconditionError(absl::StrCat(
          reader.name(),
          ": the bounds in its header are those of its points with another offset or scale "
          "of ",
          axis, ", so that one of them is wrong (", WrongBounds(reader.header(), prescan_.all, place_.frame),
          "); correct the header, or its bounds alone if the points are right"));
    }
    if (const std::string wrong = WrongBounds(reader.header(), prescan_.all, place_.frame); !wrong.empty()) {
      notes_.push_back(absl::StrCat("the header states bounds that the points do not have (", wrong,
                                    "); those of the points are used"));
      const std::array<double, 3>&least = prescan_.all.least, &greatest = prescan_.all.greatest;
      ASSIGN_OR_RETURN(
          place_,
          PlaceOf(reader, plan, formats::MapPosition{(least[0] + greatest[0]) / 2, (least[1] + greatest[1]) / 2}));
      RETURN_IF_ERROR(scan());
    }
    if (prescan_.synthetic_surface > 0)
      notes_.push_back(absl::StrCat(prescan_.synthetic_surface, " of ", prescan_.surface_returns,
                                    " returns from the water surface are synthetic: no pulse measured them"));
  }
  if (!place_.remark.empty()) notes_.push_back(place_.remark);
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<LasBeams>> LasBeams::Find(const formats::LasReader& reader,
                                                         const LasAnnotation& annotation) {
  const BeamPlan& plan = annotation.plan;
  RETURN_IF_ERROR(CheckTimes(reader, annotation));
  std::unique_ptr<LasBeams> beams(new LasBeams());
  if (plan.water_level_file.has_value()) {
    ASSIGN_OR_RETURN(beams->levels_,
                     formats::ReadWaterLevels(*plan.water_level_file, reader.header().adjusted_gps_time
                                                                          ? formats::PointTimeForm::kAdjustedStandard
                                                                          : formats::PointTimeForm::kWeekSeconds));
  }
  RETURN_IF_ERROR(beams->FindPlace(reader, annotation));
  beams->NoteLevel();
  if (annotation.seas != nullptr) RETURN_IF_ERROR(beams->FindSeas(reader, *annotation.seas));
  const WaterHeights water = {.surface = beams->prescan_.surface.has_value() ? &*beams->prescan_.surface : nullptr,
                              .levels = beams->levels_.has_value() ? &*beams->levels_ : nullptr,
                              .level = plan.water_level};
  if (plan.has_track()) RETURN_IF_ERROR(beams->FindTrack(reader, plan, water));
  beams->geometry_.emplace(plan, beams->place_.frame, water, beams->track_.get(), beams->motions_.get());
  return beams;
}

}  // namespace albtpu::annotate
