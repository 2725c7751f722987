#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/spectra/wave_spectrum.h"
#include "validation/laboratory/wave_staff.h"

namespace albtpu {
namespace {

constexpr double kTensionOverDensity = kSurfaceTension / kWaterDensity;

TEST(Dispersion, IsDominatedByGravityForLongWaves) {
  const double k = 2 * std::numbers::pi / 10;  // tension adds T k^2 / (2 rho g) = 1.5e-6
  EXPECT_NEAR(AngularFrequency(k) / std::sqrt(kGravity * k), 1, 2e-6);
}

TEST(Dispersion, IsDominatedBySurfaceTensionForRipples) {
  const double k = 1e5;  // gravity adds rho g / (2 T k^2) = 7e-6
  EXPECT_NEAR(AngularFrequency(k) / std::sqrt(kTensionOverDensity * k * k * k), 1, 1e-5);
}

// Lamb (1932), section 267: 23.2 cm/s at a wavelength of 1.73 cm, for a tension of 74 mN/m.
TEST(Dispersion, HasItsLeastPhaseSpeedAtSeventeenMillimetres) {
  double slowest = 1, wavelength = 0;
  for (double length = 0.005; length < 0.1; length += 1e-5) {
    const double k = 2 * std::numbers::pi / length;
    const double speed = AngularFrequency(k) / k;
    if (speed < slowest) {
      slowest = speed;
      wavelength = length;
    }
  }
  EXPECT_NEAR(slowest, std::sqrt(2 * std::sqrt(kGravity * kTensionOverDensity)), 1e-6);
  EXPECT_NEAR(slowest, 0.231, 0.0005);
  EXPECT_NEAR(wavelength, 0.0171, 0.00005);
  const double k = 2 * std::numbers::pi / wavelength;
  EXPECT_NEAR(GroupSpeed(k) / slowest, 1, 1e-3) << "at the least phase speed, group and phase speed are equal";
}

TEST(Dispersion, InvertsFromFrequencyToWavenumber) {
  for (double k = 0.01; k < 2e4; k *= 1.7) EXPECT_NEAR(Wavenumber(AngularFrequency(k)) / k, 1, 1e-9) << k;
  EXPECT_EQ(Wavenumber(0), 0);
}

TEST(Dispersion, HasTheDerivativeOfTheFrequencyAsGroupSpeed) {
  for (double k = 0.01; k < 2e4; k *= 3) {
    const double step = 1e-4 * k;
    const double difference = (AngularFrequency(k + step) - AngularFrequency(k - step)) / (2 * step);
    EXPECT_NEAR(GroupSpeed(k) / difference, 1, 1e-7) << k;
  }
}

SeaState Sea() { return SeaState(5.25, 8.5); }

TEST(FrequencySpectrum, HasTheVarianceOfTheSea) {
  double sum = 0;
  constexpr double kStep = 0.01;  // Hz
  for (double f = 0.5 * kStep; f < 1500; f += kStep) sum += FrequencySpectrum(Sea(), f) * kStep;
  EXPECT_NEAR(sum / ElevationVariance(Sea()), 1, 1e-3);  // 1e-4 for each of the ranges and of the sums
}

TEST(FrequencySpectrum, HasItsMaximumAtThePeakFrequency) {
  const double peak = PeakFrequency(Sea());
  for (const double aside : {0.9, 0.99, 1.01, 1.1})
    EXPECT_LT(FrequencySpectrum(Sea(), aside * peak), FrequencySpectrum(Sea(), peak)) << aside;
}

}  // namespace
}  // namespace albtpu
