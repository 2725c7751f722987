#include "validation/laboratory/wave_staff.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "generator/math/statistics.h"
#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
namespace {

constexpr int kRecords = 200;
constexpr int kSamples = 1200;
constexpr double kRate = 30;  // Hz

const SeaState& StaffSea() {
  static const SeaState sea(5.25, 8.5);
  return sea;
}

// The autocovariance of the elevation at a point, the integral of S(k) cos(omega lag) dk.
double Autocovariance(double lag) {
  const auto [lowest, highest] = StaffSea().energetic_range();
  constexpr double kLogStep = 1e-4;
  double sum = 0;
  for (double k = lowest; k < highest; k *= 1 + kLogStep)
    sum += StaffSea().S(k) * std::cos(AngularFrequency(k) * lag) * k * kLogStep;
  return sum;
}

// Sampling changes no moment: with the aliased waves the record has all the variance of the sea.
TEST(WaveStaff, HasTheAutocovarianceOfItsSpectrum) {
  const WaveStaff staff(StaffSea(), kSamples, kRate);
  std::vector<std::vector<double>> records;
  for (int r = 0; r < kRecords; ++r) records.push_back(staff.Draw(NormalStream(3, 0, static_cast<std::uint32_t>(r))));
  for (const int lag : {0, 1, 3, 7}) {
    Eigen::ArrayXd products(kRecords);
    for (int r = 0; r < kRecords; ++r) {
      double sum = 0;
      for (int n = 0; n + lag < kSamples; ++n) sum += records[r][n] * records[r][n + lag];
      products[r] = sum / (kSamples - lag);
    }
    const Estimate found = Mean(products);
    EXPECT_NEAR(found.value, Autocovariance(lag / kRate), 4 * found.standard_error) << lag;
    EXPECT_LT(found.standard_error, 0.02 * Autocovariance(0));
  }
}

TEST(WaveStaff, DoesNotRepeatWithinTheRecord) {
  const WaveStaff staff(StaffSea(), kSamples, kRate);
  Eigen::ArrayXd correlation(kRecords);
  for (int r = 0; r < kRecords; ++r) {
    const std::vector<double> record = staff.Draw(NormalStream(4, 0, static_cast<std::uint32_t>(r)));
    const Eigen::Map<const Eigen::ArrayXd> all(record.data(), kSamples);
    correlation[r] = (all.head(kSamples / 2) * all.tail(kSamples / 2)).sum() / all.square().sum() * 2;
  }
  const Estimate found = Mean(correlation);
  EXPECT_NEAR(found.value, 0, 4 * found.standard_error);
  EXPECT_LT(correlation.abs().maxCoeff(), 0.5);
}

constexpr double kSwellRate = 32;  // Hz
constexpr int kSegment = 256;

// `amplitude` sin(2 pi `frequency` t) about a mean level of 1.
std::vector<double> Swell(double amplitude, double frequency) {
  std::vector<double> record(8 * kSegment);
  for (std::size_t n = 0; n < record.size(); ++n)
    record[n] = 1 + amplitude * std::sin(2 * std::numbers::pi * frequency * static_cast<double>(n) / kSwellRate);
  return record;
}

TEST(WelchSpectrum, HasTheVarianceAndThePeakOfASineWave) {
  const RecordSpectrum spectrum = WelchSpectrum(Swell(0.3, 4), kSwellRate, kSegment);
  EXPECT_EQ(spectrum.resolution, kSwellRate / kSegment);
  EXPECT_EQ(spectrum.PeakFrequency(), 4);
  EXPECT_NEAR(spectrum.SignificantWaveHeight(), 4 * 0.3 / std::numbers::sqrt2, 1e-12);
}

// The density of white noise of variance 1 is 2 / rate at all frequencies. 799 half-overlapping segments under a Hann
// window are equivalent to 757 independent ones: 3.6 % at one frequency.
TEST(WelchSpectrum, IsFlatForWhiteNoise) {
  std::vector<double> record(400 * kSegment);
  NormalStream(1, 0, 0).Fill(record);
  const RecordSpectrum spectrum = WelchSpectrum(record, kSwellRate, kSegment);
  for (int m = 2; m < kSegment / 2; ++m) EXPECT_NEAR(spectrum.density[m] * kSwellRate / 2, 1, 0.2) << m;
  EXPECT_NEAR(spectrum.SignificantWaveHeight(), 4, 0.05);
}

TEST(HighestThird, OfASineWaveIsItsHeightFromTroughToCrest) {
  EXPECT_NEAR(HighestThird(Swell(0.3, 2)), 0.6, 1e-12);  // 16 samples a period, so that crests are sampled
}

TEST(HighestThird, IsTheMeanOfTheHighestThirdOfTheWaves) {
  std::vector<double> record;
  for (const double height : {1.0, 3.0, 1.0, 1.0, 5.0, 1.0})
    for (const double part : {0.0, 0.5, 0.0, -0.5}) record.push_back(height * part);
  record.push_back(0);
  record.push_back(0);
  // The first crossing is not detected; a third of the five waves that follow is one wave.
  EXPECT_EQ(HighestThird(record), 5);
}

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

TEST(FrequencySpectrum, HasTheVarianceOfTheSea) {
  double sum = 0;
  constexpr double kFrequencyStep = 0.01;  // Hz
  for (double f = 0.5 * kFrequencyStep; f < 1500; f += kFrequencyStep)
    sum += FrequencySpectrum(StaffSea(), f) * kFrequencyStep;
  EXPECT_NEAR(sum / ElevationVariance(StaffSea()), 1, 1e-3);  // 1e-4 for each of the ranges and of the sums
}

TEST(FrequencySpectrum, HasItsMaximumAtThePeakFrequency) {
  const double peak = PeakFrequency(StaffSea());
  for (const double aside : {0.9, 0.99, 1.01, 1.1})
    EXPECT_LT(FrequencySpectrum(StaffSea(), aside * peak), FrequencySpectrum(StaffSea(), peak)) << aside;
}

}  // namespace
}  // namespace albtpu
