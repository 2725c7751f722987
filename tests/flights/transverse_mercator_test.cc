#include "tests/flights/transverse_mercator.h"

#include <gtest/gtest.h>
#include <stdio.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "tests/flights/map_grid.h"
#include "tests/temporary_folder.h"

namespace albtpu::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Within 3 degrees of the central meridian, as in a zone of UTM and a little beyond.
std::vector<Geodetic> Places() {
  std::vector<Geodetic> places;
  for (double latitude = 20; latitude < 60; latitude += 6.1)
    for (double longitude = -84; longitude < -77.9; longitude += 1.3)
      places.push_back({latitude * kDegree, longitude * kDegree, 0});
  return places;
}

// PROJ's own algorithm is the same series summed by Poder and Engsager, so that they agree to rounding: 1e-9 m is the
// resolution of a double at 6e6 m.
TEST(TransverseMercator, AgreesWithProj) {
  if (std::system("command -v proj >/dev/null") != 0) {
    GTEST_SKIP() << "proj (package proj-bin) is not installed";
  }
  const TemporaryFolder folder;
  for (const auto& [name, definition] : {std::pair("utm17n", "+proj=utm +zone=17 +ellps=WGS84"),
                                         std::pair("florida-east-ft",
                                                   "+proj=tmerc +lat_0=24.3333333333333333 +lon_0=-81 "
                                                   "+k_0=0.999941177 +x_0=200000.00010160020 +ellps=GRS80")}) {
    std::ostringstream input;
    for (const Geodetic& place : Places())
      input << std::setprecision(17) << place.longitude / kDegree << ' ' << place.latitude / kDegree << '\n';
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

}  // namespace
}  // namespace albtpu::testing
