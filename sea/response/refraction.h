// Refraction at the air-water interface: Snell's law for one ray, and its response to small slopes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace albtpu {

// The refractive index of water at 532 nm, the wavelength of laser bathymetry, as in Birkebak et al. (2018), Eq. 17.
inline constexpr double kRefractiveIndex = 1.33;

// The direction of the ray `incident` after it has entered water of index `n` (air is 1) through a surface with the
// upward normal `normal`. Both are unit vectors, with incident . normal < 0; the result is a unit vector.
// Birkebak et al. (2018), Eq. 17, with the ratio of the indices on both terms, squared under the root.
inline Eigen::Vector3d Refract(const Eigen::Vector3d& incident, const Eigen::Vector3d& normal, double n) {
  const double ratio = 1 / n;
  const Eigen::Vector3d tangential = normal.cross(incident);  // |tangential| = sin(incidence)
  return -ratio * normal.cross(tangential) - normal * std::sqrt(1 - ratio * ratio * tangential.squaredNorm());
}

// The upward unit normal of a surface with the slopes (dz/dx, dz/dy).
inline Eigen::Vector3d NormalOfSlope(const Eigen::Vector2d& slope) {
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
}

// A refracted ray per unit of depth: its horizontal displacement and its length.
struct RefractedRay {
  Eigen::Vector2d tangent;
  double secant;
};

// The same law on a facet of slope m, without unit normals: with q = 1 + |m|^2, v = -incident . (-m, 1) and
// r = 1 / n, the refracted direction is r incident + (-m, 1) (r v - sqrt(q (1 - r^2) + r^2 v^2)) / q.
inline RefractedRay RefractAtSlope(const Eigen::Vector3d& incident, const Eigen::Vector2d& slope, double n) {
  const double ratio = 1 / n;
  const double q = 1 + slope.squaredNorm();
  const double v = ratio * (slope.dot(incident.head<2>()) - incident.z());
  const double lift = (v - std::sqrt(q * (1 - ratio * ratio) + v * v)) / q;
  const double secant = -1 / (ratio * incident.z() + lift);
  return {(ratio * incident.head<2>() - lift * slope) * secant, secant};
}

// The angle from the vertical, rad, of a ray refracted by still water: sin(incidence) = n sin(refracted).
double StillWaterRefraction(double incidence, double n);

// The response of the tangent of the refracted direction to a small slope of the surface: `in_plane` times the slope
// along the beam's azimuth, `out_of_plane` times the slope across it. With g = 1 - cos(theta) / (n cos(theta_r)),
// in_plane = g / cos^2(theta_r), out_of_plane = g; at nadir both are 1 - 1/n.
struct SlopeGain {
  double in_plane, out_of_plane;
};
SlopeGain SmallSlopeGain(double incidence, double n);

// The same response as a matrix in x and y: small slopes m deflect the tangent by TangentResponse * m.
Eigen::Matrix2d TangentResponse(double incidence, double azimuth, double n);

// The second derivatives of the secant of the refracted direction by the slope of the surface: the response of the
// path per depth to the squares of small slopes. At nadir (1 - 1/n)^2 times the identity.
Eigen::Matrix2d SecantCurvature(double incidence, double azimuth, double n);

}  // namespace albtpu
