#include "validation/laboratory/photodiode_array.h"

#include <cassert>

#include "sea/response/refraction.h"

namespace albtpu {

PhotodiodeArray::PhotodiodeArray(const PhotodiodeArrayOptions& options, const Eigen::Vector2d& centre)
    : options_(options), corner_(centre.array() - 0.5 * (options.per_side - 1) * options.pitch) {
  assert(options.per_side > 0 && options.pitch > 0);
  assert(options.aperture > 0 && options.aperture <= options.pitch);
}

std::optional<Eigen::Vector2d> PhotodiodeArray::Centroid(const std::vector<Eigen::Vector2d>& spots) const {
  const double radius = 0.5 * options_.aperture;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // of the centre of the photodiode of each hit
  long hits = 0;
  for (const Eigen::Vector2d& spot : spots) {
    const Eigen::Array2d nearest = ((spot - corner_) / options_.pitch).array().round();
    if ((nearest < 0).any() || (nearest >= options_.per_side).any()) continue;
    const Eigen::Vector2d centre = corner_ + options_.pitch * nearest.matrix();
    if ((spot - centre).squaredNorm() > radius * radius) continue;
    sum += centre;
    ++hits;
  }
  if (hits == 0) return std::nullopt;
  return sum / static_cast<double>(hits);
}

std::vector<Eigen::Vector2d> SpotsAtDepth(const std::vector<Ray>& rays, const HeightField& water,
                                          double refractive_index, double depth) {
  std::vector<Eigen::Vector2d> spots;
  spots.reserve(rays.size());
  for (const Ray& ray : rays) {
    const Hit hit = Intersect(water, ray);
    const Eigen::Vector3d refracted =
        Refract(ray.direction, NormalOfSlope(hit.facet.slope), refractive_index);
    const Eigen::Vector2d tangent = refracted.head<2>() / -refracted.z();
    spots.push_back(ray.at_zero + hit.height * ray.per_height() + (depth + hit.height) * tangent);
  }
  return spots;
}

}  // namespace albtpu
