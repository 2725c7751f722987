// The laboratory's detector: a square array of photodiodes under water, and the centroid of what they see.
//
// Source: Birkebak et al. (2018), section 2.2. The paper does not tell the aperture: 1 cm is assumed.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/height_field.h"

namespace albtpu {

struct PhotodiodeArrayOptions {
  int per_side = 6;
  double pitch = 0.05;     // m, centre to centre
  double aperture = 0.01;  // m, diameter of the round window of one photodiode, at most the pitch
};

// Immutable. Its rows lie along x and y.
class PhotodiodeArray {
 public:
  PhotodiodeArray(const PhotodiodeArrayOptions& options, const Eigen::Vector2d& centre);

  // The centroid of the samples, sum(x I) / sum(I), the intensity I of a photodiode being the number of
  // spots within its aperture. (Eq. 20 and 21 as M10 / M00 and M01 / M00: as printed, the denominator is a
  // signed sum that can vanish.) None in the dark.
  std::optional<Eigen::Vector2d> Centroid(const std::vector<Eigen::Vector2d>& spots) const;

 private:
  PhotodiodeArrayOptions options_;
  Eigen::Vector2d corner_;  // the centre of the photodiode of least x and y
};

// Where the rays, refracted by the water, pass the plane `depth` [m] below the mean surface. Rays, water
// and spots are in the same coordinates. Every ray carries the same power.
std::vector<Eigen::Vector2d> SpotsAtDepth(const std::vector<Ray>& rays, const HeightField& water,
                                          double refractive_index, double depth);

}  // namespace albtpu
