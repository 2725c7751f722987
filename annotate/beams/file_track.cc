#include "annotate/beams/file_track.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/beams/clocked_track.h"
#include "formats/clocks/point_clock.h"
#include "sea/angle.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// Height and speed in the middle of the longest segment, where they do not depend on how many rays each of its parts
// has, and the uncertainty at the times of the rays.
struct TrackStatistics {
  TrackEstimate middle;
  double sigma = 0;  // rad, median
};

std::optional<TrackStatistics> StatisticsOf(const RayTrack& track, std::span<const AirRay> rays) {
  std::vector<double> sigmas;
  for (const AirRay& ray : rays) {
    const std::optional<TrackEstimate> estimate = track.At(ray.time);
    if (estimate.has_value()) sigmas.push_back(estimate->incidence_sigma);
  }
  if (sigmas.empty()) return std::nullopt;
  const RaySegment& longest =
      *std::max_element(track.segments().begin(), track.segments().end(),
                        [](const RaySegment& a, const RaySegment& b) { return a.end - a.start < b.end - b.start; });
  return TrackStatistics{.middle = *track.At((longest.start + longest.end) / 2), .sigma = Median(std::move(sigmas))};
}

}  // namespace

TrackedFile ByClock(const TrackedFile& stated, const formats::PointClock& clock) {
  TrackedFile file = stated;
  std::erase_if(file.rays, [](const AirRay& ray) { return formats::IsNoTime(ray.time); });
  file.times = clock(file.times.span);
  for (AirRay& ray : file.rays) ray.time = clock(ray.time);
  return file;
}

absl::StatusOr<FileTrack> TrackFromReturns(const TrackedFile& given, double index, double seconds) {
  const formats::PointClock clock = {.scale = seconds, .form = given.times.form, .description = ""};
  const TrackedFile file = ByClock(given, clock);
  const auto too_few = [&](const std::string& why) {
    return absl::FailedPreconditionError(
        absl::StrCat(file.name, ": the position of the sensor cannot be derived from its returns (", why,
                     file.remark.empty() ? "" : "; ", file.remark,
                     "); check --water-level or --water-classes and --classes, or give a trajectory by --trajectory"));
  };
  if (file.rays.empty()) {
    return too_few(absl::StrCat(file.pairs,
                                " pairs of returns of one pulse at least 1 m apart, of which none lies "
                                "below the water surface"));
  }
  RayTrackOptions options;
  options.index = index;
  RayTrack track = FitTrack(file.rays, options);
  const std::optional<TrackStatistics> statistics = StatisticsOf(track, file.rays);
  if (!statistics.has_value()) {
    return too_few(absl::StrCat(file.rays.size(),
                                " pulses with two returns under water are too few, or contradict "
                                "each other"));
  }
  FileTrack found;
  found.clock = clock;
  const double height = statistics->middle.height, speed = statistics->middle.velocity.norm();
  const double sigma = DegreesOfRadians(statistics->sigma);
  *found.json = {{"pairs", file.pairs},          {"rays", file.rays.size()}, {"segments", track.segments().size()},
                 {"height_above_water", height}, {"speed", speed},           {"incidence_sigma", sigma}};
  found.notes.push_back(
      absl::StrFormat("trajectory from %d pulses with two returns under water: in the middle of its longest "
                      "part %.1f m above the water at %.1f m/s; incidence known to %.2g degrees (1 sigma)",
                      file.rays.size(), height, speed, sigma));
  if (file.map == nullptr) {
    const absl::Status database = formats::CheckProjDatabase();
    found.notes.push_back(absl::StrCat("coordinate system not known",
                                       database.ok() ? "" : absl::StrCat(" (", database.message(), ")"),
                                       ": directions are from grid north"));
  }
  found.track = std::make_unique<FittedTrack>(std::move(track), file.frame);
  found.motions = std::make_unique<CourseMotions>(*found.track);
  if (clock.changes_times()) {
    found.track = std::make_unique<ClockedTrack>(std::move(found.track), clock);
    found.motions = std::make_unique<ClockedMotions>(std::move(found.motions), clock);
  }
  return found;
}

void FittedTrack::PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                              std::span<TrackOutcome> outcomes) const {
  track_.PositionsAt(times, positions, outcomes);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (formats::IsNoTime(times[i])) outcomes[i] = TrackOutcome::kOutside;
    if (outcomes[i] != TrackOutcome::kKnown) continue;
    SensorPosition& position = positions[i];
    position.convergence = frame_.ConvergenceAt({position.x, position.y});
    const formats::MapPosition on_map = frame_.MapOf(position.x, position.y);
    position.x = on_map.x;
    position.y = on_map.y;
    position.metres_per_x = frame_.metres_per_x;
    position.metres_per_y = frame_.metres_per_y;
    position.north_per_x = frame_.north_per_x;
  }
}

}  // namespace albtpu::annotate
