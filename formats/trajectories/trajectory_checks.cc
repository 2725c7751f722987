#include "formats/trajectories/trajectory_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/crs/foot.h"
#include "sea/angle.h"

namespace albtpu::formats {
namespace {

// Times at which distances are taken. Over five hours they are 9 s or half a kilometre apart.
constexpr int kSamples = 2000;
constexpr double kSouthernFalseNorthing = 10000000;  // m, of all southern UTM zones.

std::vector<GeographicPosition> SamplePositions(const TrajectoryTimeline& timeline) {
  const TimeSpan& span = timeline.points().span;
  std::vector<GeographicPosition> samples;
  for (int i = 0; i <= kSamples; ++i) {
    const std::optional<TrajectoryRecord> record =
        timeline.RecordAt(span.first + (span.last - span.first) * i / kSamples);
    if (record.has_value()) samples.push_back({record->latitude, record->longitude});
  }
  // Points of a few moments that lie in gaps: the records nearest to them.
  if (samples.empty()) {
    for (const TimelineRun& run : timeline.runs()) {
      const TrajectoryRecord record = run.trajectory->Record(run.begin);
      samples.push_back({record.latitude, record.longitude});
    }
  }
  return samples;
}

// Minimum distance in m of projected positions from the box; infinite where none can be projected. `turn` is that of
// the frame.
double MinDistance(const std::vector<MapPosition>& positions, double turn, const MapMetric& metric,
                   const PointExtent& extent) {
  const double middle = (extent.x_min + extent.x_max) / 2;
  double least = HUGE_VAL;
  for (const MapPosition& position : positions) {
    const double along = turn > 0 ? middle + std::remainder(position.x - middle, turn) : position.x;
    const double x = std::max({extent.x_min - along, 0.0, along - extent.x_max});
    const double y = std::max({extent.y_min - position.y, 0.0, position.y - extent.y_max});
    const double distance = std::hypot(x * metric.metres_per_x, y * metric.metres_per_y);
    if (distance < least) least = distance;
  }
  return least;
}

// Changes of the geographic coordinates before projection and of the map coordinates after it.
struct Change {
  std::string description;
  std::function<GeographicPosition(GeographicPosition)> before;
  std::function<MapPosition(MapPosition)> after;
};

// "zone 18" for two zones east of zone 16, where the name of the coordinate system has a zone.
std::string NameOfZone(const std::string& crs_name, int zones) {
  const std::string lower = absl::AsciiStrToLower(crs_name);
  const std::size_t at = lower.find("utm zone ");
  if (at == std::string::npos) return "";
  const std::string digits = lower.substr(at + 9, lower.find_first_not_of("0123456789", at + 9) - (at + 9));
  int zone = 0;
  if (!absl::SimpleAtoi(digits, &zone)) return "";
  return absl::StrCat(", UTM zone ", (zone - 1 + zones + 120) % 60 + 1);
}

std::vector<Change> Changes(const MapFrame& frame) {
  const auto same = [](MapPosition position) { return position; };
  const auto unchanged = [](GeographicPosition position) { return position; };
  std::vector<Change> changes;
  changes.push_back({"the latitude and longitude of the trajectory are exchanged",
                     [](GeographicPosition p) {
                       return GeographicPosition{p.longitude, p.latitude};
                     },
                     same});
  changes.push_back({"the longitude of the trajectory has the wrong sign",
                     [](GeographicPosition p) {
                       return GeographicPosition{p.latitude, -p.longitude};
                     },
                     same});
  changes.push_back({"the latitude of the trajectory has the wrong sign",
                     [](GeographicPosition p) {
                       return GeographicPosition{-p.latitude, p.longitude};
                     },
                     same});
  changes.push_back({"x and y of the points are exchanged", unchanged, [](MapPosition p) {
                       return MapPosition{p.y, p.x};
                     }});
  if (frame.is_geographic()) return changes;
  const double unit = frame.unit();
  changes.push_back(
      {"the points are in feet, but their coordinate system states metres", unchanged, [unit](MapPosition p) {
         return MapPosition{p.x * unit / kMetresOfFoot, p.y * unit / kMetresOfFoot};
       }});
  changes.push_back(
      {"the points are in metres, but their coordinate system states another unit", unchanged, [unit](MapPosition p) {
         return MapPosition{p.x * unit, p.y * unit};
       }});
  if (!frame.is_transverse_mercator()) return changes;
  for (const double sign : {-1.0, 1.0}) {
    changes.push_back({"the points are in the zone of the other hemisphere", unchanged, [unit, sign](MapPosition p) {
                         return MapPosition{p.x, p.y + sign * kSouthernFalseNorthing / unit};
                       }});
  }
  // A position seen from another central meridian is the position turned by the angle between the two. Gauss-Krueger
  // zones are 3 degrees wide, UTM zones 6.
  for (int degrees = 3; degrees <= 180; degrees += 3) {
    for (const int sign : {-1, 1}) {
      const double turn = RadiansOfDegrees(sign * degrees);
      changes.push_back({absl::StrFormat("another zone: the points fit a central meridian %d degrees further %s%s",
                                         degrees, sign > 0 ? "east" : "west",
                                         degrees % 6 == 0 ? NameOfZone(frame.crs_name(), sign * degrees / 6) : ""),
                         [turn](GeographicPosition p) {
                           return GeographicPosition{p.latitude, p.longitude - turn};
                         },
                         same});
    }
  }
  return changes;
}

double DistanceAfter(const Change& change, const std::vector<GeographicPosition>& samples, const MapFrame& frame,
                     const MapMetric& metric, const PointExtent& extent) {
  std::vector<GeographicPosition> positions;
  for (const GeographicPosition& sample : samples) {
    const GeographicPosition changed = change.before(sample);
    if (std::abs(changed.latitude) <= std::numbers::pi / 2) positions.push_back(changed);
  }
  std::vector<MapPosition> projected(positions.size());
  frame.Project(positions, projected);
  for (MapPosition& position : projected) position = change.after(position);
  return MinDistance(projected, frame.turn(), metric, extent);
}

}  // namespace

absl::Status CheckNearPoints(const std::string& las, const TrajectoryTimeline& timeline, const MapFrame& frame,
                             const PointExtent& extent) {
  const std::vector<GeographicPosition> samples = SamplePositions(timeline);
  std::vector<MapPosition> projected(samples.size());
  frame.Project(samples, projected);
  const MapMetric metric =
      frame.is_geographic() ? frame.MetricAt(samples.front()) : MapMetric{frame.unit(), frame.unit()};
  const double distance = MinDistance(projected, frame.turn(), metric, extent);
  if (distance <= kFarthestFromPoints) return absl::OkStatus();
  double least = kFarthestFromPoints;
  std::string cause;
  for (const Change& change : Changes(frame)) {
    const double changed = DistanceAfter(change, samples, frame, metric, extent);
    // The first of equal ones: those before are simpler.
    if (changed < least) {
      least = changed;
      cause = change.description;
    }
  }
  const std::string remedy =
      cause.empty() ? "give the trajectory of this flight, or name the coordinate system of the points by --crs"
                    : "correct it, or name the coordinate system of the points by --crs";
  if (cause.empty()) {
    cause =
        "another flight, such as one at the same hours of another week, which an SBET does not name, or "
        "another coordinate system";
  }
  const GeographicPosition& sample = samples.front();
  return absl::InvalidArgumentError(absl::StrFormat(
      "%s: at the times of its points the trajectory is %s away from them in %s (%s is at latitude %.4f and "
      "longitude %.4f degrees: %s); %s",
      las, std::isfinite(distance) ? absl::StrFormat("%.1f km or more", distance / 1000) : "infinitely far",
      frame.crs_name(), timeline.runs().front().trajectory->name(), DegreesOfRadians(sample.latitude),
      DegreesOfRadians(sample.longitude), cause, remedy));
}

}  // namespace albtpu::formats
