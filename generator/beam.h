// A laser beam above the water: where it points, how wide it is, and the rays it is made of.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace albtpu {

enum class BeamProfile {
  kUniform,   // even irradiance within the diameter
  kGaussian,  // the diameter is where the irradiance falls to 1/e^2 of the centre's
};

struct BeamOptions {
  double incidence = 0;  // rad from the vertical, in air, 0 to below pi/2
  double azimuth = 0;    // rad from downwind, of the horizontal direction of travel
  double footprint = 0;  // m, diameter at the mean surface, across the axis
  BeamProfile profile = BeamProfile::kUniform;
  double source_height = std::numeric_limits<double>::infinity();  // m above the water; infinity: collimated
};

// A ray in coordinates about the point where the axis of the beam meets the water. At height z it stands over
// `at_zero + z * per_height`.
struct Ray {
  Eigen::Vector3d direction;  // unit vector, downward
  Eigen::Vector2d at_zero;    // m, where it crosses z = 0
  Eigen::Vector2d per_height() const { return direction.head<2>() / direction.z(); }
};

// Immutable. The rays sample the cross-section evenly by a sunflower spiral (the golden angle, radii of equal
// power), so that all weigh alike; a gaussian beam is cut where the spiral ends, outside of 1 - 1/(2 rays) of
// its power.
class Beam {
 public:
  Beam(const BeamOptions& options, int ray_count);

  const BeamOptions& options() const { return options_; }
  Eigen::Vector2d azimuth_direction() const;  // unit vector
  Eigen::Vector2d per_height() const;         // of the axis, as Ray::per_height
  int ray_count() const { return static_cast<int>(cross_section_.size()); }

  // The rays about a point of the water that lies `elevation` above the mean surface. Only a point source
  // feels it.
  std::vector<Ray> Rays(double elevation) const;

 private:
  BeamOptions options_;
  Eigen::Vector3d axis_;
  std::vector<Eigen::Vector3d>
      cross_section_;  // at the mean surface, relative to the axis, perpendicular to it
};

// What the footprint's average leaves of a wave with wavenumber `k` [rad/m] travelling at `psi` [rad] from
// downwind: W of the small-slope theory. The footprint on the water is an ellipse, longer by 1/cos(incidence)
// along the azimuth. With kappa = sqrt((k_along / cos(incidence))^2 + k_across^2), W = 2 J1(kappa D/2) /
// (kappa D/2) for a uniform beam and exp(-kappa^2 D^2 / 32) for a gaussian one.
double FootprintAverage(const BeamOptions& beam, double k, double psi);

// Its square, the part of the wave's power that is left.
double FootprintPower(const BeamOptions& beam, double k, double psi);

}  // namespace albtpu
