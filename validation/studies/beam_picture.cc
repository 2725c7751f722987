#include "validation/studies/beam_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/discretization.h"
#include "generator/surface/sea_surface.h"
#include "sea/angle.h"
#include "sea/response/refraction.h"

namespace albtpu {
namespace {

// The beam of section 2.1.2 at one of its incidences.
constexpr double kIncidence = 15;    // degree
constexpr double kFootprint = 0.25;  // m
constexpr double kSourceHeight = 4;  // m
constexpr double kDepth = 0.25;      // m, of the plane where the rays end
constexpr double kAbove = 0.1;       // m, of the points where the drawn rays begin
constexpr int kRays = 500'000;
constexpr int kRaysPerDrawnRay = 9001;   // one ray in this many is drawn, spread over the spiral of rays
constexpr double kDrawnSpacing = 0.003;  // m, between points of the drawn surface

// The point where a ray refracted at `hit` reaches a level.
Eigen::Vector2d EndOf(const Ray& ray, const Hit& hit, double level) {
  const Eigen::Vector3d down = Refract(ray.direction, NormalOfSlope(hit.facet.slope), kRefractiveIndex);
  const Eigen::Vector2d met = ray.at_zero + hit.height * ray.per_height();
  return met + (hit.height - level) / -down.z() * down.head<2>();
}

Eigen::Vector2d Centroid(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// The farthest points from the centroid, one for each sector, closed with the first.
std::vector<Eigen::Vector2d> EdgeOf(const std::vector<Eigen::Vector2d>& points) {
  constexpr int kSectors = 90;
  const Eigen::Vector2d centre = Centroid(points);
  std::vector<Eigen::Vector2d> edge(kSectors, centre);
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = point - centre;
    const double turn = (std::atan2(arm.y(), arm.x()) / std::numbers::pi + 1) / 2;
    Eigen::Vector2d& farthest = edge[std::min(static_cast<int>(turn * kSectors), kSectors - 1)];
    if (arm.norm() > (farthest - centre).norm()) farthest = point;
  }
  edge.push_back(edge.front());
  return edge;
}

double AreaWithin(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    twice += polygon[i - 1].x() * polygon[i].y() - polygon[i].x() * polygon[i - 1].y();
  return twice / 2;
}

void AddSpot(const std::vector<Eigen::Vector2d>& ends, const std::vector<Eigen::Vector2d>& still_ends,
             BeamPicture& picture) {
  constexpr int kBins = 120;
  constexpr double kBin = 0.003;  // m
  const Eigen::Vector2d still = Centroid(still_ends), moved = Centroid(ends);
  const std::vector<Eigen::Vector2d> edge = EdgeOf(still_ends);
  const double rays_per_bin =
      static_cast<double>(ends.size()) * kBin * kBin / AreaWithin(edge);  // of an even spot
  std::vector<int> count(kBins * kBins);
  for (const Eigen::Vector2d& end : ends) {
    const Eigen::Vector2d bin = (end - still) / kBin + Eigen::Vector2d::Constant(kBins / 2);
    if ((bin.array() >= 0).all() && (bin.array() < kBins).all())
      ++count[static_cast<int>(bin.x()) * kBins + static_cast<int>(bin.y())];
  }
  for (int i = 0; i < kBins; ++i) {
    for (int j = 0; j < kBins; ++j) {
      const Eigen::Vector2d middle = still + kBin * Eigen::Vector2d(i + 0.5 - kBins / 2, j + 0.5 - kBins / 2);
      picture.spot.rows.push_back({middle.x(), middle.y(), count[i * kBins + j] / rays_per_bin});
    }
  }
  for (const Eigen::Vector2d& point : edge) picture.still_spot.rows.push_back({point.x(), point.y()});
  picture.centroids.rows = {{std::string("still water"), still.x(), still.y()},
                            {std::string("this realization"), moved.x(), moved.y()}};
}

}  // namespace

BeamPicture PictureOf(const SeaState& sea, std::uint64_t seed) {
  const BeamOptions options{
      .incidence = RadiansOfDegrees(kIncidence), .footprint = kFootprint, .source_height = kSourceHeight};
  const SurfaceModel model(sea, options, ChooseDiscretization(sea, {options}));
  const SeaSurface surface(model, NormalStream(seed, 0, 0));
  const Beam beam(options, kRays);
  const SeaSurface::LocalSurface window =
      surface.SurfaceUnder(beam);  // about the point where the axis meets the long waves
  const HeightField& heights = window.heights;

  BeamPicture picture;
  const int half = static_cast<int>(0.98 * heights.reach() / kDrawnSpacing);
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const Eigen::Vector2d at(i * kDrawnSpacing, j * kDrawnSpacing);
      picture.surface.rows.push_back({at.x(), at.y(), heights.FacetAt(at).HeightAt(at)});
    }
  }
  const double mean_level = -window.elevation;
  const double bottom_level = mean_level - kDepth;
  const HeightField::Facet still_water{mean_level, Eigen::Vector2d::Zero()};
  std::vector<Eigen::Vector2d> ends, still_ends;
  const std::vector<Ray> rays = beam.Rays(window.elevation);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Ray& ray = rays[r];
    const Hit hit = Intersect(heights, ray);
    const Eigen::Vector2d end = EndOf(ray, hit, bottom_level);
    ends.push_back(end);
    still_ends.push_back(EndOf(ray, {mean_level, still_water}, bottom_level));
    if (r % kRaysPerDrawnRay != 0) continue;
    const Eigen::Vector2d above = ray.at_zero + kAbove * ray.per_height();
    const Eigen::Vector2d met = ray.at_zero + hit.height * ray.per_height();
    picture.rays.rows.push_back(
        {above.x(), above.y(), kAbove, met.x(), met.y(), hit.height, end.x(), end.y(), bottom_level});
  }
  AddSpot(ends, still_ends, picture);
  return picture;
}

}  // namespace albtpu
