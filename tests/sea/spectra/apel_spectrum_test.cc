#include "sea/spectra/apel_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

// Integral of k^power S dk by the trapezoidal rule in log k, fine enough to count as exact.
double Moment(const ApelSpectrum& spectrum, int power) {
  constexpr int kSteps = 20000;
  const double lowest = 0.1 * spectrum.peak_wavenumber(), step = std::log(1e5 / lowest) / kSteps;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double k = lowest * std::exp(i * step);
    sum += (i == 0 || i == kSteps ? 0.5 : 1.0) * std::pow(k, power + 1) * spectrum(k) * step;
  }
  return sum;
}

double SignificantWaveHeight(double wind_speed) {
  return 4 * std::sqrt(Moment(ApelSpectrum(wind_speed, kFullyDeveloped), 0));
}

// The fetch at which Eq. 5 gives `omega`.
double FetchOf(double omega, double wind_speed) {
  return std::pow(22 / omega, 1 / 0.33) * wind_speed * wind_speed / kGravity;
}

TEST(ApelSpectrum, HasNearlyTheWaveHeightOfPiersonAndMoskowitz) {
  EXPECT_NEAR(SignificantWaveHeight(10), 2.04, 0.005);  // printed precision
  for (const double wind_speed : {5.0, 10.0, 15.0}) {
    const double pierson_moskowitz = 0.0214 * wind_speed * wind_speed;  // 2.14 m at 10 m/s
    EXPECT_NEAR(SignificantWaveHeight(wind_speed) / pierson_moskowitz, 0.95, 0.01) << wind_speed;
  }
}

TEST(ApelSpectrum, HasTheKnownMeanSquareSlopes) {
  const auto mean_square_slope = [](double wind_speed) { return Moment(ApelSpectrum(wind_speed, kFullyDeveloped), 2); };
  constexpr double kPrinted = 0.0005;
  EXPECT_NEAR(mean_square_slope(3), 0.030, kPrinted);
  EXPECT_NEAR(mean_square_slope(5), 0.049, kPrinted);
  EXPECT_NEAR(mean_square_slope(10), 0.132, kPrinted);
  EXPECT_NEAR(mean_square_slope(15), 0.212, kPrinted);
}

TEST(ApelSpectrum, IsSteeperThanCoxAndMunkByTheStatedFactor) {
  for (const double wind_speed : {3.0, 5.0, 10.0, 15.0}) {
    const double cox_munk = 0.003 + 0.00512 * wind_speed;  // Cox and Munk (1954), clean surface
    const double ratio = Moment(ApelSpectrum(wind_speed, kFullyDeveloped), 2) / cox_munk;
    EXPECT_GT(ratio, 1.55) << wind_speed;
    EXPECT_LT(ratio, 2.75) << wind_speed;
  }
}

TEST(ApelSpectrum, PeaksAtTheWavenumberOfItsWaveAge) {
  EXPECT_DOUBLE_EQ(ApelSpectrum(10, kFullyDeveloped).peak_wavenumber(), kGravity / 100 * 0.84 * 0.84);
  EXPECT_NEAR(ApelSpectrum(5, FetchOf(2, 5)).peak_wavenumber(), kGravity / 25 * 4, 1e-12);
}

// At the peak Eq. 8 is 1, so S(k_p) = A / k_p^3 e^(-5/4) gamma (R_ro + s R_res) V_dis I_D, where gamma is Donelan's
// between Omega 1 and 5 and keeps its end values beyond.
TEST(ApelSpectrum, EnhancesThePeakOfAYoungSea) {
  constexpr double kWindSpeed = 6;
  const double s = std::pow(10, -4.95 + 3.45 * (1 - std::exp(-kWindSpeed / 4.7)));
  struct Case {
    double omega, gamma;
  };
  for (const Case c : {Case{0.84, 1.7}, {0.9, 1.7}, {2, 1.7 + 6 * std::log10(2)}, {5, 5.893820}, {9, 5.893820}}) {
    const ApelSpectrum spectrum(kWindSpeed, FetchOf(c.omega, kWindSpeed));
    const double k = spectrum.peak_wavenumber();
    // Eq. 14 is the integral of exp(-phi^2 / (2 phi_s^2)) over a full turn, here at k = k_p.
    double directional_integral = 0;
    constexpr int kSteps = 10000;
    for (int i = 0; i < kSteps; ++i) {
      const double phi = std::numbers::pi * (2 * (i + 0.5) / kSteps - 1);
      directional_integral += std::exp(-phi * phi * (0.28 + 10) / 2) * 2 * std::numbers::pi / kSteps;
    }
    const double roll_off = 1 / (1 + std::pow(k / 100, 2));
    const double resonance = 0.8 * k / std::cosh((k - 400) / 450);
    const double dissipation = std::exp(-std::pow(k / 6283, 2));
    EXPECT_NEAR(
        spectrum(k) * std::pow(k, 3) /
            (0.00195 * std::exp(-1.25) * c.gamma * (roll_off + s * resonance) * dissipation * directional_integral),
        1, 1e-6)
        << "Omega " << c.omega;
  }
}

TEST(ApelSpectrum, DoesNotChangeBeyondTheFullyDevelopedFetch) {
  const double full = ApelSpectrum::FullyDevelopedFetch(7);
  const ApelSpectrum unlimited(7, kFullyDeveloped), just(7, full * (1 + 1e-12)), far(7, 10 * full);
  for (double k = 0.05; k < 1e4; k *= 1.7) {
    EXPECT_EQ(just(k), unlimited(k));
    EXPECT_EQ(far(k), unlimited(k));
  }
}

TEST(ApelSpectrum, GrowsWithFetchUntilItIsFullyDeveloped) {
  double before = 0;
  for (const double fetch : {100.0, 1e3, 1e4, 0.9 * ApelSpectrum::FullyDevelopedFetch(7)}) {
    const double variance = Moment(ApelSpectrum(7, fetch), 0);
    EXPECT_GT(variance, before) << fetch;
    before = variance;
  }
}

TEST(ApelInverseWaveAge, FollowsTheFetchLawAndIsNeverBelowTheFullyDevelopedSea) {
  EXPECT_NEAR(ApelSpectrum::InverseWaveAge(5, 25 / kGravity), 22, 1e-12);  // k0 x = 1
  EXPECT_NEAR(ApelSpectrum::InverseWaveAge(5, FetchOf(3, 5)), 3, 1e-12);
  EXPECT_EQ(ApelSpectrum::InverseWaveAge(5, kFullyDeveloped), 0.84);
}

TEST(ApelFullyDevelopedFetch, InvertsTheFetchLaw) {
  for (const double wind_speed : {1.0, 5.0, 15.0}) {
    const double fetch = ApelSpectrum::FullyDevelopedFetch(wind_speed);
    EXPECT_NEAR(ApelSpectrum::InverseWaveAge(wind_speed, fetch), 0.84, 1e-12);
    EXPECT_NEAR(ApelSpectrum::InverseWaveAge(wind_speed, 0.5 * fetch), 0.84 * std::pow(2, 0.33), 1e-12);
  }
}

}  // namespace
}  // namespace albtpu
