#include "laz/coding/integer_coder.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace albtpu::laz {
namespace {

struct Prediction {
  std::int32_t predicted, actual;
  std::uint32_t context;
};

template <int kBits>
void ExpectRoundTrip(const std::vector<Prediction>& integers) {
  constexpr int kContexts = 3;
  ArithmeticEncoder encoder;
  encoder.Begin();
  const auto encoded = std::make_unique<IntegerCoder<ArithmeticEncoder, kBits, kContexts>>();
  std::vector<std::uint32_t> sizes;
  for (const Prediction& integer : integers) {
    EXPECT_EQ(encoded->Code(encoder, integer.predicted, integer.actual, integer.context), integer.actual);
    sizes.push_back(encoded->size());
  }
  const std::string bytes = encoder.Finish();
  const MemorySource source(bytes);
  ByteWindow window;
  ArithmeticDecoder decoder;
  decoder.Begin(window, source, 0, bytes.size());
  const auto decoded = std::make_unique<IntegerCoder<ArithmeticDecoder, kBits, kContexts>>();
  for (std::size_t i = 0; i < integers.size(); ++i) {
    ASSERT_EQ(decoded->Code(decoder, integers[i].predicted, 0, integers[i].context), integers[i].actual) << i;
    ASSERT_EQ(decoded->size(), sizes[i]) << i;
  }
  EXPECT_EQ(decoder.position(), bytes.size());
}

TEST(IntegerCoder, DecodesAllThatItEncodes) {
  std::mt19937_64 random(1);
  std::vector<Prediction> wide, narrow;
  for (int i = 0; i < 20000; ++i) {
    const auto predicted = static_cast<std::int32_t>(random() >> random() % 64);
    const auto actual = static_cast<std::int32_t>(random() >> random() % 64);
    const auto context = static_cast<std::uint32_t>(random() % 3);
    wide.push_back({predicted, i % 3 == 0 ? actual : predicted, context});
    narrow.push_back({predicted & 0xFFFF, i % 3 == 0 ? actual & 0xFFFF : predicted & 0xFFFF, context});
  }
  ExpectRoundTrip<32>(wide);
  ExpectRoundTrip<16>(narrow);
}

TEST(IntegerCoder, CodesTheLimitsOfItsRange) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min(), kMost = ~kLeast;
  std::vector<Prediction> wide;
  for (const std::int32_t predicted : {kLeast, kLeast + 1, -1, 0, 1, kMost})
    for (const std::int32_t actual : {kLeast, kLeast + 1, -1, 0, 1, kMost}) wide.push_back({predicted, actual, 0});
  ExpectRoundTrip<32>(wide);
  std::vector<Prediction> narrow;
  for (const std::int32_t predicted : {0, 1, 0x7FFF, 0x8000, 0xFFFF})
    for (const std::int32_t actual : {0, 1, 0x7FFF, 0x8000, 0xFFFF}) narrow.push_back({predicted, actual, 0});
  ExpectRoundTrip<16>(narrow);
}

TEST(IntegerCoder, StatesTheSizeOfTheDifference) {
  ArithmeticEncoder encoder;
  encoder.Begin();
  const auto coder = std::make_unique<IntegerCoder<ArithmeticEncoder, 32, 1>>();
  const auto size = [&](std::int32_t difference) {
    coder->Code(encoder, 100, 100 + difference);
    return coder->size();
  };
  EXPECT_EQ(size(0), 0u);
  EXPECT_EQ(size(1), 0u);
  EXPECT_EQ(size(-1), 1u);
  EXPECT_EQ(size(2), 1u);
  EXPECT_EQ(size(-3), 2u);
  EXPECT_EQ(size(4), 2u);
  EXPECT_EQ(size(5), 3u);
  EXPECT_EQ(size(-256), 9u);
  EXPECT_EQ(size(256), 8u);
}

}  // namespace
}  // namespace albtpu::laz
