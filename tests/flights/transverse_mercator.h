// The transverse Mercator projection of the ellipsoid by Krueger's series.
//
// Source: Karney (2011), Transverse Mercator with an accuracy of a few nanometers, doi:10.1007/s00190-011-0445-3,
// Eq. 7-11, 14, 35 and 23-28. The terms that are left out are of the order n^7 = 4e-20 of the third flattening: below
// 1e-11 m within 10 degrees of the central meridian.
#pragma once

#include <array>

#include "tests/flights/ellipsoid.h"

namespace albtpu::testing {

struct MapPoint {
  double easting = 0, northing = 0;  // m
  double convergence = 0;            // rad; true azimuth of grid north
  double scale = 1;                  // m on the map for a metre on the ellipsoid
};

class TransverseMercator {
 public:
  struct Parameters {
    Ellipsoid ellipsoid = kWgs84;
    double central_meridian = 0, latitude_of_origin = 0;  // rad
    double scale_factor = 1;
    double false_easting = 0, false_northing = 0;  // m
  };

  explicit TransverseMercator(const Parameters& parameters);

  MapPoint Project(double latitude, double longitude) const;

 private:
  struct Sphere;  // Of Eq. 7-11, before scale and offsets.
  Sphere OnSphere(double latitude, double longitude) const;

  Parameters parameters_;
  double eccentricity_ = 0;
  double rectifying_radius_ = 0;   // A, m
  std::array<double, 6> alpha_{};  // Eq. 35
  double northing_of_origin_ = 0;  // m
};

}  // namespace albtpu::testing
