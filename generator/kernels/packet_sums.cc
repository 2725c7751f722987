#include "generator/kernels/packet_sums.h"

#include <cmath>

#include "sea/response/refraction.h"

namespace albtpu {

StillWater StillWaterOf(const RayBundle& rays) {
  const double r = 1 / rays.refractive_index();
  const Eigen::Vector3d direction = rays.direction();
  const double s0 = std::sqrt(1 - r * r + r * r * direction.z() * direction.z());
  return {static_cast<float>(s0), static_cast<float>(-r * direction.z()),
          static_cast<float>(r * direction.x()), static_cast<float>(r * direction.y()),
          static_cast<float>(1 - r * r)};
}

void IntersectOne(const RayBundle& rays, const HeightView& surface, int ray, float& height, float& rise_x,
                  float& rise_y) {
  const Hit hit = Intersect(surface, Ray{rays.direction(), {rays.x()[ray], rays.y()[ray]}});
  const Eigen::Vector2d rise = hit.facet.slope * static_cast<double>(surface.spacing);
  height = static_cast<float>(hit.height);
  rise_x = static_cast<float>(rise.x());
  rise_y = static_cast<float>(rise.y());
}

TracedBundle MeansOf(const RayBundle& rays, const PacketSums& sums) {
  double mean[kPacketSums];
  for (int k = 0; k < kPacketSums; ++k) mean[k] = sums.sum[k] / rays.count();
  const RefractedRay still = RefractAtSlope(rays.direction(), {0, 0}, rays.refractive_index());
  const Eigen::Vector2d tangent(mean[kTangentX], mean[kTangentY]);  // less the tangent in still water
  TracedBundle traced;
  traced.beam.tangent = still.tangent + tangent;
  traced.beam.height_tangent =
      Eigen::Vector2d(mean[kHeightTangentX], mean[kHeightTangentY]) - mean[kHeight] * tangent;
  traced.beam.secant = still.secant + mean[kSecant];
  traced.beam.height_secant = mean[kHeightSecant] - mean[kHeight] * mean[kSecant];
  traced.beam.slope = {mean[kSlopeX], mean[kSlopeY]};
  traced.beam.slope_squares = {mean[kSlopeXX], mean[kSlopeYY], mean[kSlopeXY]};
  traced.height = mean[kHeight];
  traced.unshifted_slope = {mean[kUnshiftedX], mean[kUnshiftedY]};
  traced.unshifted_slope_squares = {mean[kUnshiftedXX], mean[kUnshiftedYY], mean[kUnshiftedXY]};
  traced.unshifted_height_slope = Eigen::Vector2d(mean[kUnshiftedHeightX], mean[kUnshiftedHeightY]) -
                                  mean[kUnshiftedHeight] * traced.unshifted_slope;
  traced.unsettled_rays = sums.unsettled_rays;
  return traced;
}

}  // namespace albtpu
