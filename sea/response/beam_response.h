// The errors of the position that one beam reports over a sea, by the response theory.
#pragma once

#include <Eigen/Core>

namespace albtpu {

// Errors are reported minus true, z up, and linear in the depth d below the mean height of the surface under the beam.
// docs/physics.md, section 1, defines them. x is downwind.
struct BeamResponse {
  // Of the error in (x, y, z) per metre of depth.
  Eigen::Matrix3d covariance_per_depth;
  // Of the error at the depth 0, m^2. The two parts are uncorrelated.
  Eigen::Matrix3d covariance_at_surface;
  Eigen::Vector3d mean_per_depth;  // of the error: the bias
  Eigen::Vector2d azimuth;         // unit vector of the beam's horizontal direction

  // 2 sigma of the angles between the mean refracted ray and that of still water, on x and on y, rad.
  double refraction_along_wind() const { return Refraction(0); }
  double refraction_cross_wind() const { return Refraction(1); }
  // In m, at a depth in m.
  Eigen::Matrix3d Covariance(double depth) const {
    return depth * depth * covariance_per_depth + covariance_at_surface;
  }
  double Thu(double depth) const;  // 2 sigma
  double Tvu(double depth) const;  // 2 sigma
  double BiasAlongBeam(double depth) const { return depth * azimuth.dot(mean_per_depth.head<2>()); }
  double BiasVertical(double depth) const { return depth * mean_per_depth.z(); }

 private:
  double Refraction(int axis) const;
};

}  // namespace albtpu
