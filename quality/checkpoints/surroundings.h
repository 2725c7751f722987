// The annotated points around each check point, and the surface that they make there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/seas/sea_timeline.h"
#include "quality/annotated/annotated_points.h"
#include "quality/checkpoints/check_points_file.h"
#include "quality/crosscheck/flight_lines.h"
#include "quality/surface/node.h"
#include "quality/surface/surface_point.h"

namespace albtpu::quality {

inline constexpr double kDefaultRadius = 2, kLeastRadius = 0.2, kMostRadius = 20;  // m
inline constexpr std::size_t kFewestPoints = 4;                                    // Three make a plane of any heights.

struct SurroundingOptions {
  double radius = kDefaultRadius;               // m
  const annotate::SeaTimeline* seas = nullptr;  // As SurfaceOptions::seas.
};

// The surface at a check point, by the node of the points around.
struct SurfaceAtPoint {
  std::size_t point = 0;  // Of the list.
  bool wet = true;        // Of bathymetric points; otherwise of dry points of the ground.
  SurfaceNode node = {};
  double tvu = 0;                      // m, at 95 %: that of its points, the mean.
  std::vector<LineOfNode> lines = {};  // By the number of the line (FlightLines), each once, in order.
  // Other surfaces that have some of the same points, by their number, above that of this one, and the correlation of
  // two means of as many independent points.
  std::vector<std::pair<std::size_t, double>> shared = {};
};

// The points of the survey within the radius of a check point, with the numbers of their lines.
struct PointsAround {
  std::vector<SurfacePoint> wet, dry;
  double wet_tvu = 0, dry_tvu = 0;  // Sums of the points' own, m, at 95 %.
};

// Of `around`, by check point, whose points it brings into order. `sources` are for cells of SideOfCircle(radius).
std::vector<SurfaceAtPoint> SurfacesOf(const std::vector<CheckPoint>& points, std::vector<PointsAround>& around,
                                       double radius, double metres_per_unit, const NodeSources& sources);

struct PlaneBox {
  double west = 0, south = 0, east = -1, north = -1;  // Units of the map; empty at first.
  bool empty() const { return east < west; }
  bool Has(double x, double y) const { return x >= west && x <= east && y >= south && y <= north; }
  void Add(double x, double y);
};

struct Surroundings {
  std::vector<SurfaceAtPoint> surfaces;  // Of the check points that have points around, in their order.
  PlaneBox box;                          // Of all points that count.
  LeftOutPoints left_out;
};

// Of bathymetric points with a number, and of dry points of the ground; of whichever there are more. Reads all files
// once. Fails as SeaOfFile().
absl::StatusOr<Surroundings> SurroundingsOf(const std::vector<AnnotatedLasFile>& files,
                                            const std::vector<CheckPoint>& points, const SurroundingOptions& options);

}  // namespace albtpu::quality
