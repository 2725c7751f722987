#include "quality/seas/sea_sharing.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "sea/angle.h"
#include "sea/sea_state.h"

namespace albtpu::quality {
namespace {

constexpr double kIndex = 1.34, kSideOfCell = 1;

// Steps of the logarithm of the footprint are 0.04 wide; this one is a step. The cubic leaves out what grows with the
// fourth power of the incidence, at 2.5 degrees 9/4 (5 degrees)^2 = 1.7 % of what grows with its square. What a pair
// shares of second order is nearly right (BeamCorrelation::SharedNearly): 4 % of the vertical variance at nadir.
TEST(SeaSharing, IsThatOfTheBeamBetweenItsSteps) {
  const double footprint = std::exp(0.04 * std::round(std::log(0.6) / 0.04));
  const WindSea wind{.wind_speed_10m = 6, .fetch = 20'000, .model = &kElfouhailyModel};
  const HarmonicSpectrum sea = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
  const WaveCorrelation waves(sea);
  SeaSharing sharing(kSideOfCell);
  sharing.Add({.spectrum = sea, .x_azimuth = std::numbers::pi / 2, .water_index = kIndex});
  for (const double incidence : {0.0, 0.43, 1.0, 2.5, 4.0, 8.5, 14.0, 20.0, 27.5, 29.0}) {
    for (const double azimuth : {0.0, 11.25, 77.0, 190.0}) {
      const std::array places = {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, -0.25)};
      const SeaOfPulses found = sharing(0, incidence, azimuth, footprint, places);
      // Of the beam by itself, x towards east.
      const BeamCorrelation beam(
          waves,
          {.incidence = RadiansOfDegrees(incidence), .azimuth = RadiansOfDegrees(90 - azimuth), .footprint = footprint},
          kIndex);
      const albtpu::SharedWaves pulse = beam.pulse(), pair = beam.Between(places[1], 0);
      const Eigen::Matrix3d errors = pulse.errors(), of_pair = pair.errors();
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double tolerance = 0.02 * std::sqrt(errors(i, i) * errors(j, j));
          EXPECT_NEAR(found.pulse.errors(i, j), errors(i, j), tolerance)
              << incidence << " " << azimuth << " " << i << j;
          EXPECT_NEAR(found.pairs.errors(i, j) / 2, of_pair(i, j), 2 * tolerance)
              << incidence << " " << azimuth << " " << i << j;
        }
      }
      EXPECT_NEAR(found.pairs.height / 2, pair.footprint.heights, 1e-3 * pulse.footprint.heights);
    }
  }
}

TEST(SeaSharing, IsNothingForBeamsThatAreNotKnown) {
  SeaSharing sharing(kSideOfCell);
  const WindSea wind{.wind_speed_10m = 6, .fetch = 20'000, .model = &kElfouhailyModel};
  sharing.Add({.spectrum = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics), .water_index = kIndex});
  const std::array places = {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, -0.25)};
  for (const auto& [incidence, azimuth, footprint] :
       {std::array{NAN, 0.0F, 0.6F}, {20.0F, NAN, 0.6F}, {20.0F, 1e30F, 0.6F}, {20.0F, 0.0F, NAN}}) {
    const SeaOfPulses found = sharing(0, incidence, azimuth, footprint, places);
    EXPECT_EQ(found.pulse.errors.norm() + found.pairs.errors.norm() + found.pulse.height, 0);
  }
}

// By paths: the light meets water that lies h too high 1 / cos(incidence) h earlier. Of the optical path that is left,
// processing lays an nth along the ray of still water from where it takes the water to be.
TEST(SeaSharing, HasWhatHeightsDoByPathsOfLight) {
  const WindSea wind{.wind_speed_10m = 6, .model = &kElfouhailyModel};
  SeaSharing sharing(kSideOfCell);
  sharing.Add({.spectrum = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics), .water_index = kIndex});
  for (const double incidence : {0.0, 20.0}) {
    const double theta = RadiansOfDegrees(incidence), azimuth = RadiansOfDegrees(50), h = 0.3;
    const double refracted = std::asin(std::sin(theta) / kIndex);
    const Eigen::Vector3d air(std::sin(theta) * std::sin(azimuth), std::sin(theta) * std::cos(azimuth),
                              -std::cos(theta));
    const Eigen::Vector3d water(std::sin(refracted) * std::sin(azimuth), std::sin(refracted) * std::cos(azimuth),
                                -std::cos(refracted));
    const double to_level = 400 / std::cos(theta), to_water = (400 - h) / std::cos(theta), in_water = 7;
    const double left = to_water + kIndex * in_water - to_level;
    const Eigen::Vector3d truth = to_water * air + in_water * water, reported = to_level * air + left / kIndex * water;
    const Eigen::Vector3d by_height = sharing(0, incidence, 50, 0.6, {}).by_height;
    EXPECT_LT((by_height + (reported - truth) / h).norm(), 1e-9) << incidence;
  }
}

}  // namespace
}  // namespace albtpu::quality
