// The detector of the laboratory: a square array of photodiodes under water, and the centroid of their signals.
//
// Source: Birkebak et al. (2018), section 2.2. The paper does not state the aperture: 1 cm is assumed.
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

// Immutable. Rows and columns are along x and y.
class PhotodiodeArray {
 public:
  PhotodiodeArray(const PhotodiodeArrayOptions& options, const Eigen::Vector2d& centre);

  // The centroid of the samples, sum(x I) / sum(I), where the intensity I of a photodiode is the number of spots
  // within its aperture. (Eq. 20 and 21 are read as M10 / M00 and M01 / M00: as printed, the denominator is a signed
  // sum that can vanish.) None if no photodiode is lit.
  std::optional<Eigen::Vector2d> Centroid(const std::vector<Eigen::Vector2d>& spots) const;

 private:
  PhotodiodeArrayOptions options_;
  Eigen::Vector2d corner_;  // the centre of the photodiode with the smallest x and y
};

// The points where the refracted rays cross the plane `depth` [m] below the mean surface. Rays, water and spots are
// in the same coordinates. Every ray carries the same power.
std::vector<Eigen::Vector2d> SpotsAtDepth(const std::vector<Ray>& rays, const HeightField& water,
                                          double refractive_index, double depth);

}  // namespace albtpu
