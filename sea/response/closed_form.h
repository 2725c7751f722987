// A beam on the water in closed form: Snell's law and its response to slopes, the beam and the average over its
// footprint, the uncertainty in the limit of small slopes, and the mean effect of waves shorter than a grid.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "sea/sea_state.h"
#include "sea/water_index.h"

namespace albtpu {

// Refraction at the air-water interface: Snell's law for one ray, and its response to small slopes.

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

// The response of the refracted ray to the slope of the water in a sea of finite slopes: the mean gain and the mean
// curvature of Snell's law over all slopes of the sea.

// F(m) = (tangent along the azimuth, tangent across it, secant) of the ray that a facet of slope m refracts, m along
// and across the azimuth too. E is the mean over the slopes of the sea; E_w weights each slope by the area that it
// turns towards the beam, 1 + tau . m with tau = (tan(incidence), 0).
struct EffectiveGains {
  // E_w[F].
  Eigen::Vector3d mean;
  // E_w[dF/dm] + (E[F] - E_w[F]) tau^T. By Stein's lemma this is the covariance of F and m under the weight, times the
  // inverse of the slopes' covariance: the linear part of the response to Gaussian waves (Bussgang's theorem).
  Eigen::Matrix<double, 3, 2> gain;
  // E_w[d^2 F_i / dm dm] of each component: the part of second order.
  std::array<Eigen::Matrix2d, 3> curvature;
};

// `slopes` is the covariance of the slopes of the whole sea along and across the azimuth. The quadrature of 10 x 10
// points is accurate to 1e-7, and so are the differences by which it is derived.
EffectiveGains EffectiveGainsOf(double incidence, double refractive_index, const Eigen::Matrix2d& slopes);

// A laser beam on the water: its direction, its width, the shape of its irradiance, and what its footprint averages.

enum class BeamProfile {
  kUniform,   // even irradiance within the diameter
  kGaussian,  // at the diameter the irradiance falls to 1/e^2 of that at the centre
};
std::string_view Name(BeamProfile profile);  // "uniform", "gaussian"
std::optional<BeamProfile> FindBeamProfile(std::string_view name);

struct BeamOptions {
  double incidence = 0;  // rad from the vertical, in air, 0 to below pi/2
  double azimuth = 0;    // rad from downwind, of the horizontal direction of travel
  double footprint = 0;  // m, diameter at the mean surface, across the axis
  BeamProfile profile = BeamProfile::kUniform;
  double source_height = std::numeric_limits<double>::infinity();  // m above the water; infinity means collimated
};

// Lengths across the beam, in diameters, in the next three. See "The profile of a footprint" in docs/physics.md.

// The irradiance over that at the centre, at the distance whose square is `squared_radius`: 1 within 1/2 and 0 beyond
// it for a uniform beam, exp(-8 r^2) for a gaussian one.
double RelativeIrradiance(BeamProfile profile, double squared_radius);

// The radius of the circle that holds the fraction `power` of the beam, from 0 to below 1: sqrt(power) / 2 for a
// uniform beam, sqrt(-ln(1 - power) / 8) for a gaussian one.
double RadiusOfPower(BeamProfile profile, double power);

// The autocorrelation of the irradiance, the integral of I(x) I(x + a) over that of I(x)^2, at the distance |a| =
// `apart`: how much of the footprint still lies over itself after a shift. 2/pi (acos a - a sqrt(1 - a^2)) for a
// uniform beam, 0 from a = 1 on; exp(-4 a^2) for a gaussian one.
double FootprintOverlap(BeamProfile profile, double apart);

// The length [m] of the footprint on the water along its longer axis. Across the beam a uniform beam is one diameter
// wide, a gaussian one two, which hold all but exp(-8) = 3e-4 of its power; on the water both are longer by
// 1 / cos(incidence).
double WidthOnWater(const BeamOptions& beam);

// The factor W by which averaging over the footprint reduces a wave of wavenumber `k` [rad/m] that travels towards
// `psi` [rad] from downwind. The footprint on the water is an ellipse, longer by 1/cos(incidence) along the azimuth.
// With kappa = sqrt((k_along / cos(incidence))^2 + k_across^2) and the diameter D, W = 2 J1(kappa D/2) / (kappa D/2)
// for a uniform beam and exp(-kappa^2 D^2 / 32) for a gaussian one.
double FootprintAverage(const BeamOptions& beam, double k, double psi);

// W^2, the fraction of the wave's power that remains.
double FootprintPower(const BeamOptions& beam, double k, double psi);

// The small-slope theory: the uncertainty of a beam in the limit of small slopes, from the spectrum alone. The section
// "The limit of small slopes" of docs/physics.md derives it.  For a footprint much smaller than the depth the spot
// moves with the footprint-averaged slope: the tangent of the mean refracted direction is linear in that slope, with
// the gains of SmallSlopeGain. The theory is the oracle of the Monte Carlo, which agrees with it as the slopes vanish
// and lies below it for steeper seas, because Snell's law is not linear in slope: THU is lower by 0.18 of the mean
// square slope of the whole sea at nadir (0.189 by the third order in slope) and by another 0.07 of it at 20 degrees,
// growing with the square of the incidence.

// 2 sigma values: angles in rad, the others in m per m of depth.
struct SmallSlopeUncertainty {
  double refraction_along_wind, refraction_cross_wind;
  double thu_per_depth;
  double tvu_per_depth;  // zero at nadir, where the vertical error is of second order in slope
};

SmallSlopeUncertainty ClosedForm(const SeaState& sea, const BeamOptions& beam, double refractive_index);

// The effect of waves shorter than the grid on the mean direction of a beam.
//
// Their slopes average out over the footprint, but refraction is not linear in slope. They shift the mean tangent and
// the mean secant of the refracted rays (the biases; at nadir the path lengthens by 1/2 g^2 times their mean square
// slope), and they change the response of a ray to the resolved waves by a few per cent in strong wind, in first
// order and, for vertical errors near nadir, in second order. See "Waves shorter than the grid" in docs/physics.md.

// The change of (tangent x, tangent y, secant) of a refracted ray as a polynomial in the resolved slope at the ray:
// `offset + gain * slope + curvature * SlopeSquares(slope)`. It is linear in the slope and its squares, so
// their means over the rays give the change of the mean.
struct UnresolvedWaves {
  Eigen::Vector3d offset;
  Eigen::Matrix<double, 3, 2> gain;
  Eigen::Matrix3d curvature;
};

// (m_x^2, m_y^2, m_x m_y).
inline Eigen::Vector3d SlopeSquares(const Eigen::Vector2d& slope) {
  return {slope.x() * slope.x(), slope.y() * slope.y(), slope.x() * slope.y()};
}

// A facet of slope m stands for a patch of water with the slopes m + delta, where delta is normal with the covariance
// `unresolved`: that of the sea less that of the facets, `resolved`. (All cells are cut along the same diagonal, which
// correlates the two slopes of the facets; the slopes of the sea have no such correlation, and the difference removes
// it.) Rays see the slopes with the weight of the facing area, 1 + tan(theta) (m + delta) . phi. The mean over delta is
// taken by quadrature. Of its difference from the value at delta = 0 the result is the first two orders in Hermite
// polynomials of the resolved slopes: their mean response to it, not that at m = 0.
UnresolvedWaves EffectOfUnresolvedWaves(const BeamOptions& beam, double refractive_index,
                                        const Eigen::Matrix2d& unresolved, const Eigen::Matrix2d& resolved);

}  // namespace albtpu
