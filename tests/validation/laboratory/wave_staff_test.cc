#include "validation/laboratory/wave_staff.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "generator/math/statistics.h"
#include "validation/laboratory/dispersion.h"
#include "validation/laboratory/frequency_spectrum.h"

namespace albtpu {
namespace {

constexpr int kRecords = 200;
constexpr int kSamples = 1200;
constexpr double kRate = 30;  // Hz

SeaState Sea() { return SeaState(5.25, 8.5); }

// Integral of S(k) cos(omega lag) dk: what the elevation at a point has in common with itself a while later.
double Autocovariance(double lag) {
  const auto [lowest, highest] = Sea().energetic_range();
  constexpr double kLogStep = 1e-4;
  double sum = 0;
  for (double k = lowest; k < highest; k *= 1 + kLogStep) {
    sum += Sea().S(k) * std::cos(AngularFrequency(k) * lag) * k * kLogStep;
  }
  return sum;
}

TEST(FrequencySpectrum, HasTheVarianceOfTheSea) {
  double sum = 0;
  constexpr double kStep = 0.01;  // Hz
  for (double f = 0.5 * kStep; f < 1500; f += kStep) sum += FrequencySpectrum(Sea(), f) * kStep;
  EXPECT_NEAR(sum / ElevationVariance(Sea()), 1, 1e-3);  // 1e-4 each of both ranges, and of both sums
}

TEST(FrequencySpectrum, IsHighestAtItsPeak) {
  const double peak = PeakFrequency(Sea());
  for (const double aside : {0.9, 0.99, 1.01, 1.1}) {
    EXPECT_LT(FrequencySpectrum(Sea(), aside * peak), FrequencySpectrum(Sea(), peak)) << aside;
  }
}

// Sampling changes no moment: with the folded waves the record has all of the sea's variance.
TEST(WaveStaff, RecordsWhatTheSpectrumSays) {
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

}  // namespace
}  // namespace albtpu
