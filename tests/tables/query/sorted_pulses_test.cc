#include "tables/query/sorted_pulses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "tests/instruction_sets.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::SyntheticTable;

constexpr std::size_t kSize = 4096;

class SortedPulsesTest : public testing::OnInstructionSet {
 protected:
  // Incidence and depth are random in the domain of the table, the other coordinates constant.
  SortedPulsesTest() : table_(SyntheticTable()), grid_(table_.table()), incidence_(kSize), depth_(kSize), thu_(kSize) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> incidence(0, 25), depth(0, 20);
    for (float& number : incidence_) number = incidence(random);
    for (float& number : depth_) number = depth(random);
    pulses_.size = kSize;
    pulses_.axis = {std::span(&wind_speed_, 1), {}, incidence_, {}, std::span(&footprint_, 1), depth_};
  }

  bool IsScattered(const PulseColumns& pulses) const {
    PulseBlock block(grid_, pulses, kBlock);
    block.MoveTo(kBlock, kBlock);
    return block.IsScattered();
  }

  const float wind_speed_ = 5, footprint_ = 0.5f;
  const UncertaintyTable table_;
  const Grid grid_;
  std::vector<float> incidence_, depth_, thu_;
  PulseColumns pulses_;
};
ALBTPU_ON_EACH_INSTRUCTION_SET(SortedPulsesTest);

// InterpolateOnAllCores cuts 65 536 pulses into pieces of 8192, and interpolates a block of each piece first.
TEST(FewestPulsesToSort, AreFewerThanAPieceForTheShippedTables) {
  constexpr std::size_t kSurvey = 721'280, kPiece = 8192 - kBlock;
  EXPECT_LE(SortedPulses::Fewest(kSurvey), kPiece);
  EXPECT_GT(SortedPulses::Fewest(kSurvey), kBlock);
}

TEST(FewestPulsesToSort, AreNeverReachedForTablesThatFitIntoTheCacheOrAreTooLarge) {
  EXPECT_EQ(SortedPulses::Fewest(0), SortedPulses::kNever);
  EXPECT_EQ(SortedPulses::Fewest(50'000), SortedPulses::kNever);
  EXPECT_EQ(SortedPulses::Fewest(20'000'000), SortedPulses::kNever);
}

TEST_P(SortedPulsesTest, PutsPulsesOfACellNextToEachOther) {
  EXPECT_TRUE(IsScattered(pulses_));
  const SortedPulses sorted(grid_, pulses_, 0, kSize);
  ASSERT_EQ(sorted.pulses().size, kSize);
  EXPECT_FALSE(IsScattered(sorted.pulses()));
}

TEST_P(SortedPulsesTest, KeepsPulsesTogetherAndConstantColumnsInPlace) {
  const SortedPulses sorted(grid_, pulses_, 8, kSize - 8);
  using Pair = std::pair<float, float>;
  std::vector<Pair> before, after;
  for (std::size_t i = 8; i < kSize; ++i) before.emplace_back(incidence_[i], depth_[i]);
  for (std::size_t i = 0; i + 8 < kSize; ++i)
    after.emplace_back(sorted.pulses()[AxisId::kIncidence][i], sorted.pulses()[AxisId::kDepth][i]);
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after);
  EXPECT_EQ(sorted.pulses()[AxisId::kWindSpeed].data(), &wind_speed_);
  EXPECT_TRUE(sorted.pulses()[AxisId::kAzimuth].empty());
}

// Two columns of answers, of which any may be unwanted.
struct TwoColumns {
  float* numbers = nullptr;
  std::uint8_t* outcomes = nullptr;
  float* unwanted = nullptr;
};
template <typename Visit>
void ForEachColumn(const TwoColumns& wanted, TwoColumns& other, const Visit& visit) {
  if (wanted.numbers != nullptr) visit(wanted.numbers, other.numbers);
  if (wanted.outcomes != nullptr) visit(wanted.outcomes, other.outcomes);
  if (wanted.unwanted != nullptr) visit(wanted.unwanted, other.unwanted);
}

TEST_P(SortedPulsesTest, CopiesAnswersBackInTheOrderOfThePulses) {
  constexpr std::size_t kBegin = 16, kCount = 4000;
  std::vector<std::uint8_t> outcomes(kSize, 9);
  std::fill(thu_.begin(), thu_.end(), -1.0f);
  const TwoColumns wanted{.numbers = thu_.data(), .outcomes = outcomes.data()};
  const SortedPulses sorted(grid_, pulses_, kBegin, kCount);
  SortedAnswers<TwoColumns> answers(sorted, wanted);
  const std::span<const float> depths = sorted.pulses()[AxisId::kDepth];
  for (std::size_t i = 0; i < kCount; ++i) {
    answers.columns().numbers[i] = 2 * depths[i];
    answers.columns().outcomes[i] = depths[i] < 10 ? 1 : 2;
  }
  EXPECT_EQ(answers.columns().unwanted, nullptr);
  answers.CopyBack();
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool asked = i >= kBegin && i < kBegin + kCount;
    ASSERT_EQ(thu_[i], asked ? 2 * depth_[i] : -1);
    ASSERT_EQ(outcomes[i], asked ? (depth_[i] < 10 ? 1 : 2) : 9);
  }
}

}  // namespace
}  // namespace albtpu
