#include "validation/laboratory/wave_staff.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "generator/math/statistics.h"

namespace albtpu {
namespace {

constexpr int kRecords = 200;
constexpr int kSamples = 1200;
constexpr double kRate = 30;  // Hz

SeaState Sea() { return SeaState(5.25, 8.5); }

// The autocovariance of the elevation at a point, the integral of S(k) cos(omega lag) dk.
double Autocovariance(double lag) {
  const auto [lowest, highest] = Sea().energetic_range();
  constexpr double kLogStep = 1e-4;
  double sum = 0;
  for (double k = lowest; k < highest; k *= 1 + kLogStep)
    sum += Sea().S(k) * std::cos(AngularFrequency(k) * lag) * k * kLogStep;
  return sum;
}

// Sampling changes no moment: with the aliased waves the record has all the variance of the sea.
TEST(WaveStaff, HasTheAutocovarianceOfItsSpectrum) {
  const WaveStaff staff(Sea(), kSamples, kRate);
  for (const int lag : {0, 1, 3, 7}) {
    Eigen::ArrayXd products(kRecords);
    for (int r = 0; r < kRecords; ++r) {
      const std::vector<double> record = staff.Draw(NormalStream(3, 0, static_cast<std::uint32_t>(r)));
      double sum = 0;
      for (int n = 0; n + lag < kSamples; ++n) sum += record[n] * record[n + lag];
      products[r] = sum / (kSamples - lag);
    }
    const Estimate found = Mean(products);
    EXPECT_NEAR(found.value, Autocovariance(lag / kRate), 4 * found.standard_error) << lag;
    EXPECT_LT(found.standard_error, 0.02 * Autocovariance(0));
  }
}

TEST(WaveStaff, DoesNotRepeatWithinTheRecord) {
  const WaveStaff staff(Sea(), kSamples, kRate);
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

}  // namespace
}  // namespace albtpu
