#include "validation/laboratory/wave_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

constexpr double kRate = 32;  // Hz
constexpr int kSegment = 256;

// `amplitude` sin(2 pi `frequency` t) about a mean level of 1.
std::vector<double> Swell(double amplitude, double frequency) {
  std::vector<double> record(8 * kSegment);
  for (std::size_t n = 0; n < record.size(); ++n) {
    record[n] = 1 + amplitude * std::sin(2 * std::numbers::pi * frequency * static_cast<double>(n) / kRate);
  }
  return record;
}

TEST(WelchSpectrum, HasTheVarianceAndThePeakOfASine) {
  const RecordSpectrum spectrum = WelchSpectrum(Swell(0.3, 4), kRate, kSegment);
  EXPECT_EQ(spectrum.resolution, kRate / kSegment);
  EXPECT_EQ(spectrum.PeakFrequency(), 4);
  EXPECT_NEAR(spectrum.SignificantWaveHeight(), 4 * 0.3 / std::numbers::sqrt2, 1e-12);
}

// The density of white noise of variance 1 is 2 / rate at all frequencies. 799 half-overlapping segments under
// Hann's window are worth 757 independent ones: 3.6 % at one frequency.
TEST(WelchSpectrum, IsFlatForWhiteNoise) {
  std::vector<double> record(400 * kSegment);
  NormalStream(1, 0, 0).Fill(record);
  const RecordSpectrum spectrum = WelchSpectrum(record, kRate, kSegment);
  for (int m = 2; m < kSegment / 2; ++m) EXPECT_NEAR(spectrum.density[m] * kRate / 2, 1, 0.2) << m;
  EXPECT_NEAR(spectrum.SignificantWaveHeight(), 4, 0.05);
}

TEST(HighestThird, OfASineIsFromTroughToCrest) {
  EXPECT_NEAR(HighestThird(Swell(0.3, 2)), 0.6, 1e-12);  // 16 samples a period: crests are among them
}

TEST(HighestThird, IsTheMeanOfTheHighestThirdOfTheWaves) {
  std::vector<double> record;
  for (const double height : {1.0, 3.0, 1.0, 1.0, 5.0, 1.0}) {
    for (const double part : {0.0, 0.5, 0.0, -0.5}) record.push_back(height * part);
  }
  record.push_back(0);
  record.push_back(0);
  // The first crossing is not seen; of the five waves that follow, a third is one.
  EXPECT_EQ(HighestThird(record), 5);
}

}  // namespace
}  // namespace albtpu
