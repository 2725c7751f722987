#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "annotate/beams/pulse_sample.h"

namespace albtpu::annotate {
namespace {

std::vector<ReturnPair> PairsAt(double start, double step, std::size_t count) {
  std::vector<ReturnPair> pairs(count);
  for (std::size_t i = 0; i < count; ++i) {
    pairs[i].time = start + step * static_cast<double>(i);
    pairs[i].upper = {static_cast<double>(i), 0, -1};
    pairs[i].lower = {static_cast<double>(i), 0, -3};
  }
  return pairs;
}

std::vector<double> TimesOfSample(const std::vector<ReturnPair>& pairs, const PairSampleSize& size) {
  PairSample sample(size);
  for (const ReturnPair& pair : pairs) sample.Add(pair);
  EXPECT_EQ(sample.seen(), pairs.size());
  std::vector<double> times;
  for (const ReturnPair& pair : sample.Take()) times.push_back(pair.time);
  return times;
}

TEST(PairSample, KeepsAllPairsWhereThereAreFew) {
  const std::vector<ReturnPair> pairs = PairsAt(1.4e8, 0.01, 100);
  const std::vector<double> times = TimesOfSample(pairs, {});
  ASSERT_EQ(times.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(times[i], pairs[i].time);
}

TEST(PairSample, IsSpreadOverTheTimeAndBounded) {
  // 4 in each of 256 bins are too many; 2 are not.
  const PairSampleSize size{.bin = 0.25, .pairs_per_bin = 4, .pairs = 1000};
  std::map<double, int> by_bin;
  for (const double time : TimesOfSample(PairsAt(0, 1.0 / 1024, 64 * 1024), size)) ++by_bin[std::floor(time / 0.25)];
  EXPECT_EQ(by_bin.size(), 256u);
  for (const auto& [bin, count] : by_bin) EXPECT_EQ(count, 2) << bin;
}

TEST(PairSample, DoesNotDependOnTheOrder) {
  const PairSampleSize size{.bin = 0.25, .pairs_per_bin = 4, .pairs = 300};
  std::vector<ReturnPair> pairs = PairsAt(5, 1.0 / 256, 40000);
  const std::vector<double> expected = TimesOfSample(pairs, size);
  EXPECT_LE(expected.size(), 300u);
  EXPECT_GT(expected.size(), 100u);
  std::mt19937 random(1);
  for (int i = 0; i < 3; ++i) {
    std::shuffle(pairs.begin(), pairs.end(), random);
    EXPECT_EQ(TimesOfSample(pairs, size), expected);
  }
}

}  // namespace
}  // namespace albtpu::annotate
