// Waves and turbid water in one simulation, against the sum of what each does alone.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "sea/angle.h"
#include "tests/every_case.h"
#include "tests/validation/physics/waves_and_scattering.h"

namespace albtpu {
namespace {

// Half a minute of one core for a case. A third of the realizations tell the ratio of two standard deviations over the
// same waves to 0.05; both limits are farther from what is found.
const bool kEveryCase = albtpu::testing::EveryCase();
const int kTurbidSeas = kEveryCase ? 200 : 66, kPhotonsOfSea = 8000;

struct TurbidCase {
  std::string name;
  double attenuation, field_of_view, nanoseconds, footprint;
  bool always = false;

  friend std::ostream& operator<<(std::ostream& out, const TurbidCase& c) { return out << c.name; }
};

class WavesOverTurbidWater : public ::testing::TestWithParam<TurbidCase> {};

// What totals assume: variances add, biases add.
TEST_P(WavesOverTurbidWater, AddUpAsIndependentShares) {
  const TurbidCase& c = GetParam();
  // What is compared is two simulations, so that one case notices a change of either.
  if (!c.always && !kEveryCase) GTEST_SKIP() << "ALBTPU_EVERY_CASE=1 runs it";
  // Albedo 0.8; the attenuation is that of diffuse light by Kirk's factor of 0.256.
  const double absorption = c.attenuation / std::sqrt(1 + 0.256 * 4);
  const ComparedEffects found = Compare(PhaseFunction::FournierForand(0.0183),
                                        {.trip = {.incidence = RadiansOfDegrees(12),
                                                  .scattering = 4 * absorption,
                                                  .absorption = absorption,
                                                  .field_of_view = c.field_of_view,
                                                  .footprint = c.footprint},
                                         .nanoseconds = c.nanoseconds},
                                        kTurbidSeas, kPhotonsOfSea, 1);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    const ReportedBottom &waves = found.waves[d], &both = found.both[d], &scattering = found.scattering[d];
    std::printf("%-14s %-8s along: sigma %.3f by waves, %.3f with scattering; mean %.3f + %.3f, %.3f together\n",
                c.name.c_str(), std::string(kDetectorNames[d]).c_str(), waves.sigma_along, both.sigma_along,
                waves.mean_along, scattering.mean_along, both.mean_along);
    std::printf("%-14s %-8s vertical: sigma %.3f by waves, %.3f with scattering; mean %.3f + %.3f, %.3f together\n", "",
                "", waves.sigma_vertical, both.sigma_vertical, waves.mean_vertical, scattering.mean_vertical,
                both.mean_vertical);
    // Scattering blurs the tilts of the waves: independent shares overstate what the waves do, and never understate it.
    EXPECT_LT(both.sigma_along, waves.sigma_along * 1.02);
    EXPECT_GT(both.sigma_along, waves.sigma_along * 0.6);
    EXPECT_LT(both.sigma_vertical, waves.sigma_vertical * 1.02);
    EXPECT_NEAR(both.mean_vertical, waves.mean_vertical + scattering.mean_vertical, 0.02);
    EXPECT_NEAR(both.mean_along, waves.mean_along + scattering.mean_along, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, WavesOverTurbidWater,
                         ::testing::Values(TurbidCase{"wide", 0.1, 16, 5, 2}, TurbidCase{"wide_turbid", 0.2, 16, 5, 2},
                                           TurbidCase{"narrow", 0.1, 3, 1.5, 0.5},
                                           TurbidCase{"narrow_turbid", 0.2, 3, 1.5, 0.5, true}),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace albtpu
