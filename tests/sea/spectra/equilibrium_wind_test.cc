#include "sea/spectra/equilibrium_wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

// E of Thomson et al. (2013) in equilibrium with a friction velocity, in bins of `step` Hz up to `highest`.
BinnedSpectrum InEquilibrium(double friction_velocity, double step, double highest) {
  std::vector<double> f;
  std::vector<DirectionalEnergy> bins;
  for (double at = step; at <= highest + 1e-9; at += step) {
    f.push_back(at);
    bins.push_back({.energy = 0.012 * 2.5 * kGravity * friction_velocity / (2 * std::pow(std::numbers::pi, 3)) *
                              std::pow(at, -4)});
  }
  return BinnedSpectrum(std::make_shared<const std::vector<double>>(std::move(f)), bins, 0, 0.4);
}

TEST(EquilibriumWind, IsThatWhichRaisedTheWaves) {
  EXPECT_NEAR(*EquilibriumFrictionVelocity(InEquilibrium(0.3, 0.001, 0.5)), 0.3, 1e-5);
  EXPECT_NEAR(*EquilibriumFrictionVelocity(InEquilibrium(0.3, 0.001, 0.3)), 0.3, 1e-5);
}

// Toba's law, E(omega) = alpha g u* omega^-4, with alpha = 4 beta I = 0.12.
TEST(EquilibriumWind, FollowsTobasLaw) {
  const double u = 0.25, f = 0.3, omega = 2 * std::numbers::pi * f;
  const double toba = 2 * std::numbers::pi * 0.12 * kGravity * u * std::pow(omega, -4);
  EXPECT_NEAR(InEquilibrium(u, 0.001, 0.5)(f).energy / toba, 1, 1e-6);
}

TEST(EquilibriumWind, IsUnknownWithoutTheFrequenciesThatTellIt) {
  EXPECT_FALSE(EquilibriumFrictionVelocity(InEquilibrium(0.3, 0.01, 0.19)).has_value());
}

TEST(WindSpeedOfFrictionVelocity, InvertsTheDragLaw) {
  for (const double wind_speed : {0.1, 3.0, 12.0, 40.0})
    EXPECT_NEAR(WindSpeedOfFrictionVelocity(FrictionVelocity(wind_speed)) / wind_speed, 1, 1e-12);
  EXPECT_EQ(WindSpeedOfFrictionVelocity(0), 0);
}

TEST(WindSpeedAt10m, InvertsTheProfile) {
  for (const double height : {2.0, 4.1, 10.0, 19.5})
    EXPECT_NEAR(WindSpeedAt10m(WindSpeedAt(height, 7), height), 7, 1e-11);
  EXPECT_GT(WindSpeedAt10m(7, 4.1), 7);
  EXPECT_EQ(WindSpeedAt10m(0, 4.1), 0);
}

}  // namespace
}  // namespace albtpu
