#include <gtest/gtest.h>

#include <cmath>

#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"
#include "validation/studies/real_sea_study.h"

namespace albtpu {
namespace {

// Cox and Munk fitted the total separately: 5.12e-3 instead of 3.16e-3 + 1.92e-3.
TEST(ObservedSeas, HaveSlopesAlongAndAcrossThatNearlySumToTheTotal) {
  for (const double wind : {2.0, 8.0, 14.0}) {
    const double sum = CoxMunkAlongWind(wind).mean_square + CoxMunkCrossWind(wind).mean_square;
    EXPECT_NEAR(CoxMunkTotal(wind).mean_square - sum, 0.04e-3 * WindSpeedAt(12.5, wind), 1e-12);
  }
}

// The integral of Pierson and Moskowitz's alpha g^2 / omega^5 exp(-beta (g / (U omega))^4).
TEST(ObservedSeas, HaveTheHeightOfTheSpectrumOfPiersonAndMoskowitz) {
  constexpr double kWind = 11, kStep = 1e-4;
  double variance = 0;
  for (double omega = 0.1; omega < 30; omega += kStep) {
    variance += 8.1e-3 * kGravity * kGravity / std::pow(omega, 5) *
                std::exp(-0.74 * std::pow(kGravity / (kWind * omega), 4)) * kStep;
  }
  EXPECT_NEAR(PiersonMoskowitzWaveHeight(kWind) / (4 * std::sqrt(variance)), 1, 1e-4);
  EXPECT_NEAR(PiersonMoskowitzWaveHeight(10), 2.13, 0.005);  // 0.21 U^2 / g
  EXPECT_EQ(PiersonMoskowitzWaveHeightOf(10), PiersonMoskowitzWaveHeight(WindSpeedAt(19.5, 10)));
}

TEST(ObservedSeas, GrowWithTheRootOfFetchUntilFullyDeveloped) {
  EXPECT_NEAR(JonswapWaveHeight(10, 4e3) / JonswapWaveHeight(10, 1e3), 2, 1e-12);
  EXPECT_NEAR(JonswapWaveHeight(10, 1e3), 1.6e-3 * std::sqrt(kGravity * 1e3 / 100) * 100 / kGravity, 1e-12);
  EXPECT_EQ(JonswapWaveHeight(10, 1e7), PiersonMoskowitzWaveHeightOf(10));
}

}  // namespace
}  // namespace albtpu
