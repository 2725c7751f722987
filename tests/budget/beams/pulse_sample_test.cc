#include "budget/beams/pulse_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace albtpu {
namespace {

PulseReturn Return(double time, int number, int count, int channel = 0) {
  return {.record = 0,
          .time = time,
          .position = {time, 0, -1.0 * number},
          .number = static_cast<std::uint8_t>(number),
          .count = static_cast<std::uint8_t>(count),
          .channel = static_cast<std::uint8_t>(channel),
          .chosen = true};
}

std::vector<PulseReturn> Pulses(int pulses) {
  std::vector<PulseReturn> returns;
  for (int number = 1; number <= 2; ++number)
    for (int i = 0; i < pulses; ++i) returns.push_back(Return(1.4e8 + 1e-4 * i, number, 2));
  return returns;
}

std::set<double> TimesOf(const std::vector<PulseReturn>& returns, std::size_t most) {
  PulseSample sample(most);
  for (const PulseReturn& one : returns) sample.Add(one);
  std::set<double> times;
  for (const std::vector<PulseReturn>& pulse : sample.Take()) {
    EXPECT_EQ(pulse.size(), 2u);
    times.insert(pulse[0].time);
  }
  return times;
}

TEST(PulseSample, KeepsWholePulses) {
  EXPECT_EQ(TimesOf(Pulses(500), 1000).size(), 500u);
  // Of 100 000 pulses with two returns, a power of two of parts: between a half of 1000 returns and all of them, within
  // 5 standard deviations of the number that a random part has.
  const std::size_t pulses = TimesOf(Pulses(100000), 1000).size();
  EXPECT_GT(pulses, 250u - 5 * 16);
  EXPECT_LE(pulses, 500u);
}

TEST(PulseSample, DoesNotDependOnTheOrder) {
  std::vector<PulseReturn> returns = Pulses(20000);
  const std::set<double> times = TimesOf(returns, 1000);
  std::mt19937 random(1);
  std::shuffle(returns.begin(), returns.end(), random);
  EXPECT_EQ(TimesOf(returns, 1000), times);
}

TEST(PulseSample, LeavesOutWhatIsNotOnePulse) {
  PulseSample sample;
  for (const PulseReturn& one : {Return(1, 1, 3), Return(1, 3, 3),                   // One pulse.
                                 Return(2, 1, 2),                                    // Alone.
                                 Return(3, 1, 2), Return(3, 1, 2),                   // One number.
                                 Return(4, 1, 2), Return(4, 2, 2), Return(4, 3, 2),  // Too many.
                                 Return(5, 1, 2, 0), Return(5, 2, 2, 1), Return(6, 1, 2), Return(6, 2, 3)})
    sample.Add(one);
  const auto pulses = sample.Take();
  ASSERT_EQ(pulses.size(), 1u);
  EXPECT_EQ(pulses[0][0].number, 1);
  EXPECT_EQ(pulses[0][1].number, 3);
}

TEST(PulseSample, IsBoundedWhereAllTimesAreEqual) {
  PulseSample sample(1000);
  for (int i = 0; i < 100000; ++i) sample.Add(Return(0, 1 + i % 2, 2));
  EXPECT_TRUE(sample.Take().empty());
}

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

// Of several pairs a pulse, so that the last place of a bin falls among equal times.
TEST(PairSample, OfPartsIsThatOfAll) {
  for (const std::size_t most : {300u, 3000u, 100'000u}) {
    const PairSampleSize size{.bin = 0.25, .pairs_per_bin = 10, .pairs = most};
    std::vector<ReturnPair> pairs = PairsAt(5, 1.0 / 256, 40000);
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].time = pairs[i - i % 3].time;
    const std::vector<double> expected = TimesOfSample(pairs, size);
    std::mt19937 random(3);
    for (const bool in_order : {true, false}) {
      if (!in_order) std::shuffle(pairs.begin(), pairs.end(), random);
      PairSample sample(size), part(size);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        part.Add(pairs[i]);
        if (i % 1777 != 0 && i + 1 != pairs.size()) continue;
        part.Prune();
        sample.Merge(part);
        part.Clear();
      }
      EXPECT_EQ(sample.seen(), pairs.size());
      std::vector<double> times;
      for (const ReturnPair& pair : sample.Take()) times.push_back(pair.time);
      EXPECT_EQ(times, expected) << most << " " << in_order;
    }
  }
}

}  // namespace
}  // namespace albtpu
