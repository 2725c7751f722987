// What the kernels of the packet tracer share with the rest of it, whatever they are compiled for.
#pragma once

#include <Eigen/Core>

#include "generator/kernels/ray_bundle.h"
#include "generator/surface/height_field.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {

// What is summed over the rays: the height [m] where they met the water, tangent and secant less those of
// still water, the product of the height and these, slopes of the facets that they met, and their squares; of
// what is undisturbed the slopes, their squares, the height and its product with the slopes.
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

// Which of them; a beam needs none of the undisturbed.
enum class Wanted { kBeam, kBeamAndUnshifted };

struct PacketSums {
  double sum[kPacketSums] = {};
  int met_alone = 0;
};

// A ray in still water: with r = 1 / n, c the cosine of the incidence and h the horizontal part of the
// incident direction.
struct StillWater {
  float s0;            // cosine of the refracted direction, sqrt(1 - r^2 + r^2 c^2)
  float rc, rhx, rhy;  // r c and r h
  float one_less_r2;   // 1 - r^2
};
StillWater StillWaterOf(const RayBundle& rays);

// Means over the rays of a bundle.
struct TracedBundle {
  TracedBeam beam;
  double height;  // m, of where the rays met the water
  // Of the facets over or under which the rays cross z = 0, where they would meet the water were its height
  // not to shift them: linear and quadratic in the heights.
  Eigen::Vector2d unshifted_slope;
  Eigen::Vector3d unshifted_slope_squares;  // as SlopeSquares
  Eigen::Vector2d unshifted_height_slope;   // m, covariance of height and slope (height_slope_product.h)
  int met_alone;  // rays that had to be met one by one, because their packet did not settle
};

TracedBundle MeansOf(const RayBundle& rays, const PacketSums& sums);

// The meeting of one ray by Intersect's exact search: its height [m] and the rises [m a step of the grid] of
// the facet.
void IntersectOne(const RayBundle& rays, const HeightView& surface, int ray, float& height, float& rise_x,
                  float& rise_y);

}  // namespace albtpu
