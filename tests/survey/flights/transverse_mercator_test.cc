#include "tests/survey/flights/transverse_mercator.h"

#include <gtest/gtest.h>
#include <stdio.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "tests/survey/flights/map_grid.h"
#include "tests/temporary_folder.h"

namespace albtpu::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Within 3 degrees of the central meridian, as in a zone of UTM and a little beyond.
std::vector<Geodetic> Places() {
  std::vector<Geodetic> places;
  for (double latitude = 20; latitude < 60; latitude += 6.1) {
    for (double longitude = -84; longitude < -77.9; longitude += 1.3) {
      places.push_back({latitude * kDegree, longitude * kDegree, 0});
    }
  }
  return places;
}

// PROJ's own algorithm is the same series summed by Poder and Engsager, so that they agree to rounding: 1e-9 m is the
// resolution of a double at 6e6 m.
TEST(TransverseMercator, AgreesWithProj) {
  if (std::system("command -v proj >/dev/null") != 0)
    GTEST_SKIP() << "proj (package proj-bin) is not installed";
  const TemporaryFolder folder;
  for (const auto& [name, definition] :
       {std::pair("utm17n", "+proj=utm +zone=17 +ellps=WGS84"),
        std::pair("florida-east-ft",
                  "+proj=tmerc +lat_0=24.3333333333333333 +lon_0=-81 "
                  "+k_0=0.999941177 +x_0=200000.00010160020 +ellps=GRS80")}) {
    std::ostringstream input;
    for (const Geodetic& place : Places()) {
      input << std::setprecision(17) << place.longitude / kDegree << ' ' << place.latitude / kDegree << '\n';
    }
    const std::string in = folder.Write("in", input.str()), out = folder / "out";
    const std::string command = std::string("proj -f %.11f ") + definition + " <" + in + " >" + out;
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream answers(out);
    for (const Geodetic& place : Places()) {
      double easting = 0, northing = 0;
      ASSERT_TRUE(answers >> easting >> northing);
      const MapPoint point = FindMapGrid(name)->projection->Project(place.latitude, place.longitude);
      EXPECT_NEAR(point.easting, easting, 2e-9) << name;
      EXPECT_NEAR(point.northing, northing, 4e-9) << name;
    }
  }
}

// On the central meridian the northing is the length of the meridian, the integral of its radius of curvature; by
// Simpson's rule with 2000 steps, whose error is below 1e-12 of it.
TEST(TransverseMercator, MeasuresTheCentralMeridian) {
  const TransverseMercator projection({.ellipsoid = kGrs80, .scale_factor = 0.9996});
  constexpr int kSteps = 2000;
  const double latitude = 0.6, step = latitude / kSteps;
  double sum = kGrs80.MeridianRadius(0) + kGrs80.MeridianRadius(latitude);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4 : 2) * kGrs80.MeridianRadius(i * step);
  const MapPoint point = projection.Project(latitude, 0);
  EXPECT_NEAR(point.northing, 0.9996 * sum * step / 3, 4e-9);
  EXPECT_EQ(point.easting, 0);
  EXPECT_EQ(point.convergence, 0);
  EXPECT_NEAR(point.scale, 0.9996, 1e-12);
}

// Central differences over 1e-4 rad (600 m): rounding 1e-9 m / 600 m, and the third derivative (1e-4)^2 / 6.
TEST(TransverseMercator, ConvergenceAndScaleAreThoseOfItsDerivatives) {
  const TransverseMercator projection = *FindMapGrid("utm17n")->projection;
  constexpr double kStep = 1e-4;  // rad
  for (const Geodetic& place : Places()) {
    const MapPoint here = projection.Project(place.latitude, place.longitude);
    const MapPoint north = projection.Project(place.latitude + kStep, place.longitude);
    const MapPoint south = projection.Project(place.latitude - kStep, place.longitude);
    const double east_of_north = north.easting - south.easting, up = north.northing - south.northing;
    // True north lies -convergence clockwise from grid north.
    EXPECT_NEAR(here.convergence, -std::atan2(east_of_north, up), 1e-8);
    const double metres = 2 * kStep * kWgs84.MeridianRadius(place.latitude);
    EXPECT_NEAR(here.scale, std::hypot(east_of_north, up) / metres, 1e-8);
  }
}

}  // namespace
}  // namespace albtpu::testing
