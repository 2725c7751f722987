#include "laz/coding/symbol_model.h"

#include <gtest/gtest.h>

#include <random>

namespace albtpu::laz {
namespace {

TEST(SymbolModel, BeginsWithEqualProbabilities) {
  SymbolModel<128, true> model;
  model.Prepare();
  for (std::uint32_t symbol = 0; symbol < 128; ++symbol) EXPECT_EQ(model.Below(symbol), symbol << 8);
}

TEST(SymbolModel, LearnsTheSymbolThatIsCoded) {
  SymbolModel<8, true> model;
  model.Prepare();
  for (int i = 0; i < 30000; ++i) model.Count(5);
  // Each other symbol keeps a share.
  for (std::uint32_t symbol = 0; symbol < 7; ++symbol) EXPECT_LT(model.Below(symbol), model.Below(symbol + 1));
  EXPECT_GT(model.Below(6) - model.Below(5), 32000u);
}

TEST(SymbolModel, ForgetsWhatItLearned) {
  SymbolModel<8, true> model;
  model.Prepare();
  for (int i = 0; i < 1000; ++i) model.Count(5);
  model.Forget();
  model.Prepare();
  for (std::uint32_t symbol = 0; symbol < 8; ++symbol) EXPECT_EQ(model.Below(symbol), symbol << 12);
}

// In each state of learning the symbol of a number is the one in whose share it lies, as a search through all shows.
template <int kSymbols>
void ExpectSymbolsOfAllNumbers(int symbols) {
  std::mt19937 random(1);
  SymbolModel<kSymbols, true> model(symbols);
  for (int i = 0; i < 3000; ++i) {
    model.Prepare();
    for (std::uint32_t number = random() % 256; number < (1u << kProbabilityBits) + 64; number += 256) {
      std::uint32_t expected = model.last_symbol();
      while (model.Below(expected) > number) --expected;
      ASSERT_EQ(model.SymbolAt(number), expected) << "number " << number << " after " << i << " symbols";
    }
    model.Count(i % 5 == 0 ? random() % static_cast<unsigned>(symbols) : static_cast<unsigned>(symbols) / 2);
  }
}

TEST(SymbolModel, FindsTheSymbolOfEachNumber) {
  ExpectSymbolsOfAllNumbers<2>(2);
  ExpectSymbolsOfAllNumbers<6>(6);
  ExpectSymbolsOfAllNumbers<33>(33);
  ExpectSymbolsOfAllNumbers<64>(64);
  ExpectSymbolsOfAllNumbers<128>(128);
  ExpectSymbolsOfAllNumbers<256>(4);
  ExpectSymbolsOfAllNumbers<256>(256);
  ExpectSymbolsOfAllNumbers<516>(516);
}

TEST(BitModel, LearnsTheBitThatIsCoded) {
  BitModel model;
  EXPECT_EQ(model.zero(), 1u << (BitModel::kProbabilityBits - 1));
  for (int i = 0; i < 10000; ++i) model.Count(true);
  EXPECT_LT(model.zero(), 20u);
  EXPECT_GT(model.zero(), 0u);
  for (int i = 0; i < 50000; ++i) model.Count(false);
  EXPECT_GT(model.zero(), (1u << BitModel::kProbabilityBits) - 20);
  EXPECT_LT(model.zero(), 1u << BitModel::kProbabilityBits);
}

}  // namespace
}  // namespace albtpu::laz
