#include "tests/flights/transverse_mercator.h"

#include <cmath>
#include <complex>

namespace albtpu::testing {

struct TransverseMercator::Sphere {
  std::complex<double> position;    // zeta = xi + i eta: northing and easting in units of A
  std::complex<double> derivative;  // d zeta / d zeta'
  double tau = 0, conformal_tau = 0, longitude = 0;
};

TransverseMercator::TransverseMercator(const Parameters& parameters) : parameters_(parameters) {
  const double flattening = parameters.ellipsoid.flattening();
  eccentricity_ = std::sqrt(parameters.ellipsoid.eccentricity_squared());
  const double n = flattening / (2 - flattening), n2 = n * n, n3 = n2 * n, n4 = n2 * n2, n5 = n4 * n, n6 = n3 * n3;
  rectifying_radius_ =  // Eq. 14
      parameters.ellipsoid.semi_major_axis / (1 + n) * (1 + n2 / 4 + n4 / 64 + n6 / 256);
  alpha_ = {n / 2 - n2 * 2 / 3 + n3 * 5 / 16 + n4 * 41 / 180 - n5 * 127 / 288 + n6 * 7891 / 37800,
            n2 * 13 / 48 - n3 * 3 / 5 + n4 * 557 / 1440 + n5 * 281 / 630 - n6 * 1983433 / 1935360,
            n3 * 61 / 240 - n4 * 103 / 140 + n5 * 15061 / 26880 + n6 * 167603 / 181440,
            n4 * 49561 / 161280 - n5 * 179 / 168 + n6 * 6601661 / 7257600,
            n5 * 34729 / 80640 - n6 * 3418889 / 1995840,
            n6 * 212378941 / 319334400};
  northing_of_origin_ = parameters.scale_factor * rectifying_radius_ *
                        OnSphere(parameters.latitude_of_origin, parameters.central_meridian).position.real();
}

TransverseMercator::Sphere TransverseMercator::OnSphere(double latitude, double longitude) const {
  Sphere sphere;
  sphere.longitude = longitude - parameters_.central_meridian;
  const double tau = std::tan(latitude), secant = std::sqrt(1 + tau * tau);
  const double sigma = std::sinh(eccentricity_ * std::atanh(eccentricity_ * tau / secant));  // Eq. 9
  const double conformal = tau * std::sqrt(1 + sigma * sigma) - sigma * secant;              // Eq. 7
  const double cosine = std::cos(sphere.longitude);
  const std::complex<double> spherical(  // Eq. 10
      std::atan2(conformal, cosine), std::asinh(std::sin(sphere.longitude) / std::hypot(conformal, cosine)));
  sphere.tau = tau;
  sphere.conformal_tau = conformal;
  sphere.position = spherical;
  sphere.derivative = 1;
  for (std::size_t j = 1; j <= alpha_.size(); ++j) {  // Eq. 11 and its derivative
    const double order = 2.0 * static_cast<double>(j);
    sphere.position += alpha_[j - 1] * std::sin(order * spherical);
    sphere.derivative += order * alpha_[j - 1] * std::cos(order * spherical);
  }
  return sphere;
}

MapPoint TransverseMercator::Project(double latitude, double longitude) const {
  const Sphere sphere = OnSphere(latitude, longitude);
  const double unit = parameters_.scale_factor * rectifying_radius_;
  const double sine = std::sin(latitude), cosine = std::cos(sphere.longitude);
  MapPoint point;
  point.easting = parameters_.false_easting + unit * sphere.position.imag();
  point.northing = parameters_.false_northing + unit * sphere.position.real() - northing_of_origin_;
  // Eq. 23-26: of the sphere, then of the series, whose derivative is p' - i q'.
  point.convergence =
      std::atan(sphere.conformal_tau / std::hypot(1, sphere.conformal_tau) * std::tan(sphere.longitude)) -
      std::arg(sphere.derivative);
  point.scale = parameters_.scale_factor * rectifying_radius_ / parameters_.ellipsoid.semi_major_axis *
                std::sqrt(1 - parameters_.ellipsoid.eccentricity_squared() * sine * sine) * std::hypot(1, sphere.tau) /
                std::hypot(sphere.conformal_tau, cosine) * std::abs(sphere.derivative);
  return point;
}

}  // namespace albtpu::testing
