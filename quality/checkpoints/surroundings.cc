#include "quality/checkpoints/surroundings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "formats/las/las_points.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/seas/sea_sharing.h"
#include "quality/surface/cell_plane.h"
#include "quality/surface/surface_part.h"
#include "quality/surface/surface_point.h"
#include "quality/surface/survey_surface.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

// Brings points to the check points that they lie around.
class CheckPointFinder {
 public:
  CheckPointFinder(const std::vector<CheckPoint>& points, double radius) : points_(points), radius_(radius) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (const int row : {-1, 0, 1})
        for (const int column : {-1, 0, 1})
          near_[KeyOf(Step(points[i].x) + column, Step(points[i].y) + row)].push_back(i);
  }

  template <typename Do>
  void ForEachNear(double x, double y, Do&& visit) const {
    const auto found = near_.find(KeyOf(Step(x), Step(y)));
    if (found == near_.end()) return;
    for (const std::size_t i : found->second)
      if (std::hypot(points_[i].x - x, points_[i].y - y) <= radius_) visit(i);
  }

 private:
  std::int64_t Step(double at) const { return static_cast<std::int64_t>(std::floor(at / radius_)); }
  // Equal keys of two squares only make more points to look at.
  static std::uint64_t KeyOf(std::int64_t column, std::int64_t row) {
    return MixBits(static_cast<std::uint64_t>(column)) ^ static_cast<std::uint64_t>(row);
  }

  const std::vector<CheckPoint>& points_;
  double radius_;  // Units of the map.
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> near_;
};

struct GatheredPoints {
  std::vector<PointsAround> around;  // By check point.
  PartFacts facts = {};              // Their seas and sources.
  LineTimes times = {};
  PlaneBox box = {};
  LeftOutPoints left_out = {};
};

absl::Status GatherAround(const std::vector<AnnotatedLasFile>& files, const CheckPointFinder& finder,
                          const annotate::SeaTimeline* seas, GatheredPoints& gathered) {
  annotate::FileProgress progress = ProgressOver(files);
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    ASSIGN_OR_RETURN(const SeaOfSource sea, SeaOfFile(file, seas));
    ASSIGN_OR_RETURN(const std::uint16_t source, AddSource(gathered.facts, sea, GroupsOf(file, false)));
    const HorizontalGroups dry_groups = GroupsOf(file, true);
    ASSIGN_OR_RETURN(const std::uint16_t dry_source, AddSource(gathered.facts, sea, dry_groups));
    const double to_95 = VerticalFactor(Coverage::kP95) / VerticalFactor(file.coverage());
    const auto add = [&](const AnnotatedPoint& point, const auto& take) {
      if (!point.has_number) return;
      gathered.box.Add(point.x, point.y);
      gathered.times.Add(point.line, point.time);
      finder.ForEachNear(point.x, point.y, [&](std::size_t i) { take(gathered.around[i]); });
    };
    const auto add_wet = [&](const AnnotatedPoint& point) {
      add(point, [&](PointsAround& around) {
        around.wet.push_back(SurfacePointOf(point, file.coverage(), source));
        around.wet_tvu += to_95 * point.tvu;
      });
    };
    const auto add_dry = [&](const DryPoint& dry) {
      add(dry.point, [&](PointsAround& around) {
        around.dry.push_back(DrySurfacePointOf(dry, file.coverage(), dry_groups, dry_source));
        around.dry_tvu += to_95 * dry.point.tvu;
      });
    };
    ASSIGN_OR_RETURN(const LeftOutPoints of_file, file.ForEach(
                                                      progress,
                                                      [&](std::span<const AnnotatedPoint> points) {
                                                        for (const AnnotatedPoint& point : points) add_wet(point);
                                                      },
                                                      [&](const DryPoint& dry) {
                                                        if (dry.of_ground) add_dry(dry);
                                                      }));
    gathered.left_out.Add(of_file);
  }
  return absl::OkStatus();
}

// Lines by their numbers; the points of one whose line is not known have their ID.
void NumberLines(const FlightLines& lines, std::vector<SurfacePoint>& points) {
  for (SurfacePoint& point : points)
    point.flight_line = lines.NumberOf(point.flight_line, point.time).value_or(point.flight_line);
}

// A line that sees the place twice, with a pause between, is one line for all places.
std::vector<LineOfNode> OncePerLine(const std::vector<LineOfNode>& lines) {
  std::map<std::uint16_t, LineOfNode> by_line;
  for (const LineOfNode& each : lines) {
    LineOfNode& line = by_line.try_emplace(each.flight_line, LineOfNode{each.flight_line, each.time, 0}).first->second;
    line.sigma = std::hypot(line.sigma, each.sigma);
  }
  std::vector<LineOfNode> once;
  for (const auto& [number, line] : by_line) once.push_back(line);
  return once;
}

std::size_t InBoth(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
  std::size_t both = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    const auto of_a = i->Order(), of_b = j->Order();
    if (of_a == of_b) ++both;
    if (of_a <= of_b) ++i;
    if (of_b <= of_a) ++j;
  }
  return both;
}

}  // namespace

void PlaneBox::Add(double x, double y) {
  if (empty()) west = east = x, south = north = y;
  west = std::min(west, x), east = std::max(east, x), south = std::min(south, y), north = std::max(north, y);
}

std::vector<SurfaceAtPoint> SurfacesOf(const std::vector<CheckPoint>& points, std::vector<PointsAround>& around,
                                       double radius, double metres_per_unit, const NodeSources& sources) {
  std::vector<SurfaceAtPoint> found;
  std::vector<const std::vector<SurfacePoint>*> of_surfaces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool wet = around[i].wet.size() >= around[i].dry.size();
    std::vector<SurfacePoint>& taken = wet ? around[i].wet : around[i].dry;
    if (taken.size() < kFewestPoints) continue;
    std::ranges::sort(taken, {}, &SurfacePoint::Order);
    SurfaceAtPoint surface{.point = i, .wet = wet};
    std::vector<LineOfNode> of_node;
    surface.node = NodeOfCircle(taken, points[i].x, points[i].y, radius, metres_per_unit, sources, of_node);
    if (surface.node.points == 0) continue;
    surface.lines = OncePerLine(of_node);
    surface.tvu = (wet ? around[i].wet_tvu : around[i].dry_tvu) / static_cast<double>(taken.size());
    for (std::size_t j = 0; j < found.size(); ++j) {
      const CheckPoint& other = points[found[j].point];
      if (std::hypot(other.x - points[i].x, other.y - points[i].y) >= 2 * radius / metres_per_unit) continue;
      const auto both = static_cast<double>(InBoth(*of_surfaces[j], taken));
      const double of_both = static_cast<double>(of_surfaces[j]->size()) * static_cast<double>(taken.size());
      if (both > 0) found[j].shared.emplace_back(found.size(), both / std::sqrt(of_both));
    }
    found.push_back(std::move(surface));
    of_surfaces.push_back(&taken);
  }
  return found;
}

absl::StatusOr<Surroundings> SurroundingsOf(const std::vector<AnnotatedLasFile>& files,
                                            const std::vector<CheckPoint>& points, const SurroundingOptions& options) {
  const double unit = files.front().metres_per_unit(), radius = options.radius;
  GatheredPoints gathered{.around = std::vector<PointsAround>(points.size())};
  RETURN_IF_ERROR(GatherAround(files, CheckPointFinder(points, radius / unit), options.seas, gathered));
  SeaSharing sharing(SideOfCircle(radius));
  for (const SeaOfSource& sea : gathered.facts.seas) sharing.Add(sea);
  const std::vector<SourceOfPoints>& all = gathered.facts.sources;
  const NodeSources sources = {.sea =
                                   [&](std::uint16_t source, double incidence, double azimuth, double footprint,
                                       std::span<const Eigen::Vector2d> places) {
                                     return sharing(all[source].sea, incidence, azimuth, footprint, places);
                                   },
                               .groups = [&](std::uint16_t source) { return all[source].groups; },
                               .metres_per_unit = unit};
  const FlightLines lines(gathered.times);
  for (PointsAround& around : gathered.around) NumberLines(lines, around.wet), NumberLines(lines, around.dry);
  return Surroundings{.surfaces = SurfacesOf(points, gathered.around, radius, unit, sources),
                      .box = gathered.box,
                      .left_out = gathered.left_out};
}

}  // namespace albtpu::quality
