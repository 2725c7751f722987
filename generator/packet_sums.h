// What the kernels of the packet tracer share with the rest of it, whatever they are compiled for.
#pragma once

#include "generator/height_window.h"
#include "generator/packet_tracer.h"
#include "generator/ray_bundle.h"

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
  kUndisturbedX,
  kUndisturbedY,
  kUndisturbedXX,
  kUndisturbedYY,
  kUndisturbedXY,
  kUndisturbedHeight,
  kUndisturbedHeightX,
  kUndisturbedHeightY,
  kPacketSums
};

// Which of them; a beam needs none of the undisturbed.
enum class Wanted { kBeam, kBeamAndUndisturbed };

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

TracedBundle MeansOf(const RayBundle& rays, const PacketSums& sums);

// The meeting of one ray by Intersect's exact search: its height [m] and the rises [m a step of the grid] of
// the facet.
void MeetOne(const RayBundle& rays, const HeightWindow& surface, int ray, float& height, float& rise_x,
             float& rise_y);

}  // namespace albtpu
