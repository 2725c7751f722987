#include "tests/flights/beam_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/flights/survey.h"

namespace albtpu::testing {
namespace {

TEST(Refract, FollowsSnellsLawInThePlaneOfIncidence) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, -0.2, 1).normalized();
  for (double angle = 0.05; angle < 1.5; angle += 0.1) {
    const Eigen::Vector3d beam =
        Eigen::AngleAxisd(angle, normal.cross(Eigen::Vector3d(1, 0.3, 0)).normalized()) * -normal;
    const Eigen::Vector3d refracted = Refract(beam, normal);
    EXPECT_NEAR(refracted.norm(), 1, 1e-15);
    EXPECT_NEAR(beam.cross(normal).norm(), kIndexOfWater * refracted.cross(normal).norm(), 1e-15);
    EXPECT_NEAR(beam.cross(normal).dot(refracted), 0, 1e-15);
    EXPECT_LT(refracted.dot(normal), 0);
  }
}

// In the triangle of the sensor, the water point and the centre of a sphere, sin(incidence) = (R + H)/R sin(angle from
// the sensor's nadir). The ellipsoid's radius lies between the two principal ones, whose difference moves it by
// H/R * 0.7 % = 4e-7.
TEST(BeamPath, MeetsCurvedWaterSteeperThanFlat) {
  RandomNumbers random(1);
  const AreaChart chart(0.5, 0.1);
  const Coast coast{.shoreline = -1000, .deepest_at = 1000};
  const WavySurface flat(0, 0, random);
  const Scene scene{chart, coast, flat};
  const double height = 500, angle = 20 * kDegree;
  const Eigen::Vector3d sensor = EarthCentred({0.5, 0.1, height});
  const Eigen::Matrix3d axes = EastNorthUp(0.5, 0.1);
  for (const double azimuth : {0.3, 1.9, -2.4}) {
    const Eigen::Vector3d beam = axes * Eigen::Vector3d(std::sin(angle) * std::sin(azimuth),
                                                        std::sin(angle) * std::cos(azimuth), -std::cos(angle));
    const BeamPath path = PathToWater(scene, sensor, beam, 0);
    const Geodetic water = GeodeticFrom(path.water_point);
    EXPECT_NEAR(water.height, 0, 4e-9);
    const double radius = PrimeVerticalRadius(0.5);
    EXPECT_NEAR(std::sin(path.incidence), (radius + height) / radius * std::sin(angle), 4e-7);
    EXPECT_GT(path.incidence, angle + 2e-5);
    EXPECT_NEAR((path.water_point - sensor).norm(), path.slant_range, 1e-8);
    EXPECT_NEAR(path.azimuth, azimuth, 3e-5);  // Meridians converge: 180 m / R tan(latitude).
    // Straight on under water, to the ground.
    const double distance = DistanceToGround(scene, path.water_point, path.water_direction);
    const Geodetic ground = GeodeticFrom(path.water_point + distance * path.water_direction);
    EXPECT_NEAR(ground.height, coast.HeightAt(chart.EastNorth(ground)), 4e-9);
  }
}

TEST(WavySurface, HasTheHeightAndTheSlopesOfItsSpectrum) {
  RandomNumbers random(3);
  const WavySurface waves(0.3, 0.7, random);
  double elevation = 0, slope = 0, worst = 0;
  constexpr int kPlaces = 20000;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector2d place(random.Uniform(0, 5000), random.Uniform(0, 5000));
    const WavySurface::Local here = waves.At(place, 10);
    elevation += here.elevation * here.elevation / kPlaces;
    slope += here.slope.squaredNorm() / kPlaces;
    // The slopes are the derivatives of the elevation: 2e-4 m apart, third derivatives below 10 /m^2.
    const WavySurface::Local east = waves.At(place + Eigen::Vector2d(1e-4, 0), 10);
    const WavySurface::Local west = waves.At(place - Eigen::Vector2d(1e-4, 0), 10);
    worst = std::max(worst, std::abs(here.slope.x() - (east.elevation - west.elevation) / 2e-4));
  }
  // The variance of Gaussian elevations, estimated from n places: a factor of 1 +- sqrt(2/n) = 0.01; Hs half of that.
  EXPECT_NEAR(4 * std::sqrt(elevation), 0.3, 4 * 0.3 * 0.005);
  // The integral of k^2 S(k) between 20 m and 1 m, as the exponential integral:
  // sigma^2 1.25 k_p^2 (E1(0.0125) - E1(5)) / (exp(-0.0125) - exp(-5)) = 0.0108. 48 waves are random within steps of
  // 6 % in k: 1 % of the slope, three times.
  EXPECT_NEAR(std::sqrt(slope), 0.104, 0.003);
  EXPECT_LT(worst, 1e-7);
}

// Each pulse once more, from what its truth says, in plane geometry.
TEST(Simulate, PlacesReturnsWhereTheirTruthSays) {
  SurveyOptions options;
  options.seconds = 10;
  const SimulatedSurvey survey = Simulate(options);
  ASSERT_GT(survey.returns.size(), 10000u);
  std::size_t pairs = 0;
  for (const SimulatedReturn& found : survey.returns) {
    const SimulatedPulse& pulse = survey.pulses[found.pulse];
    if (found.kind == ReturnKind::kLand) continue;
    pairs += found.kind == ReturnKind::kColumn;
    EXPECT_NEAR(options.water_level - found.position.height, found.depth, 4e-9);
    const double in_water = std::asin(std::sin(pulse.incidence) / kIndexOfWater);
    const double distance = pulse.slant_range * std::sin(pulse.incidence) + found.depth * std::tan(in_water);
    const Eigen::Matrix3d axes = EastNorthUp(pulse.sensor.latitude, pulse.sensor.longitude);
    const Eigen::Vector3d between = EarthCentred(found.position) - EarthCentred(pulse.sensor);
    // The vertical turns by 160 m / R = 2.5e-5 on the way; over 430 m that is 11 mm, half of it before the water.
    EXPECT_NEAR(std::hypot(axes.col(0).dot(between), axes.col(1).dot(between)), distance, 0.02);
    EXPECT_NEAR(std::atan2(axes.col(0).dot(between), axes.col(1).dot(between)),
                std::remainder(pulse.azimuth, 2 * std::numbers::pi), 3e-5);
  }
  EXPECT_GT(pairs, 500u);
}

}  // namespace
}  // namespace albtpu::testing
