// The rays of a collimated beam in the layout of the packet tracer (single precision, neighbours side by side), and the
// sums and means that it computes over them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {

// The rays of a collimated beam in the layout of the packet tracer: in single precision, with neighbours side by side.
//
// Immutable. All rays have the same direction and enter water of the same refractive index; they differ in where they
// cross z = 0. A Morton curve through these points is divided into strips of equal length. The rays are stored
// interleaved: the first of each strip, the second of each strip, and so on. A ray and the one kStrips before it
// therefore meet the water side by side.
class RayBundle {
 public:
  static constexpr int kStrips = 32;

  // `beam` is collimated.
  RayBundle(const Beam& beam, double refractive_index) : RayBundle(beam.Rays(0), refractive_index) {}
  // `rays` have one direction; not empty.
  RayBundle(const std::vector<Ray>& rays, double refractive_index);

  int count() const { return count_; }
  double refractive_index() const { return refractive_index_; }
  const Eigen::Vector3d& direction() const { return direction_; }  // unit vector, downward
  double x_per_height() const { return direction_.x() / direction_.z(); }
  double y_per_height() const { return direction_.y() / direction_.z(); }
  bool vertical() const { return direction_.x() == 0 && direction_.y() == 0; }

  // Where the rays cross z = 0, m from the centre of the beam. The last ray is repeated up to a multiple of kStrips.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }

 private:
  int count_;
  double refractive_index_;
  Eigen::Vector3d direction_;
  std::vector<float> x_, y_;
};

// The part of the packet tracer that does not depend on the instruction set. packet_tracer.cc is compiled once for each
// instruction set, so these types are declared here, once.

// The sums over the rays: the height [m] of the intersection with the water; tangent and secant less those of still
// water; the products of height and these; slopes of the intersected facets and their squares. The unshifted sums are
// taken where the rays cross z = 0, where they would intersect the water if its height did not shift them: slopes,
// their squares, the height and its products with the slopes.
enum PacketSum {
  kHeight,
  kTangentX,
  kTangentY,
  kSecant,
  kHeightTangentX,
  kHeightTangentY,
  kHeightSecant,
  kSlopeX,
  kSlopeY,
  kSlopeXX,
  kSlopeYY,
  kSlopeXY,
  kUnshiftedX,
  kUnshiftedY,
  kUnshiftedXX,
  kUnshiftedYY,
  kUnshiftedXY,
  kUnshiftedHeight,
  kUnshiftedHeightX,
  kUnshiftedHeightY,
  kPacketSums
};

// Which sums to compute. A traced beam needs none of the unshifted ones; control variates do.
enum class Wanted { kBeam, kBeamAndUnshifted };

struct PacketSums {
  double sum[kPacketSums] = {};
  int unsettled_rays = 0;
};

// A ray in still water, with r = 1 / n, c the cosine of the incidence and h the horizontal part of the incident
// direction.
struct StillWater {
  float s0;            // cosine of the refracted direction, sqrt(1 - r^2 + r^2 c^2)
  float rc, rhx, rhy;  // r c and r h
  float one_less_r2;   // 1 - r^2
};
StillWater StillWaterOf(const RayBundle& rays);

// Means over the rays of a bundle.
struct TracedBundle {
  TracedBeam beam;
  double height;  // of the intersections with the water, m
  // Unshifted means, over the facets above or below the points where the rays cross z = 0. The mean slope is linear in
  // the heights, the mean squares are quadratic.
  Eigen::Vector2d unshifted_slope;
  Eigen::Vector3d unshifted_slope_squares;  // as SlopeSquares
  Eigen::Vector2d unshifted_height_slope;   // covariance of height and slope over the rays, m
  // Rays whose packet did not converge; each was intersected by the exact search of ray_tracer.h.
  int unsettled_rays;
};

TracedBundle MeansOf(const RayBundle& rays, const PacketSums& sums);

// Intersects one ray with the exact search of ray_tracer.h: the height [m], and the rises of the facet in m per step
// of the grid.
void IntersectOne(const RayBundle& rays, const HeightView& surface, int ray, float& height, float& rise_x,
                  float& rise_y);

}  // namespace albtpu
