#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "laz/coding/arithmetic_decoder.h"
#include "laz/coding/arithmetic_encoder.h"

namespace albtpu::laz {
namespace {

// All kinds of symbols in turn, by models that both directions have.
template <typename Coder>
class Mixture {
 public:
  // Codes the i-th symbols, or gives them when decoding: the same in both directions if nothing is lost.
  std::uint64_t Code(Coder& coder, std::uint64_t random, int i) {
    std::uint64_t sum = coder.Symbol(few_, static_cast<std::uint32_t>(random % 4));
    sum = sum * 256 + coder.Symbol(bytes_, static_cast<std::uint32_t>(random % 7 * (random >> 60)));
    sum = sum * 516 + coder.Symbol(many_, static_cast<std::uint32_t>(random >> 8) % 516);
    const int count = 1 + i % 32;
    sum ^= std::uint64_t{coder.Bits(count, static_cast<std::uint32_t>(random >> (64 - count)))} << 20;
    if (i % 100 == 0) sum += coder.Bits64(random);
    return sum;
  }

 private:
  typename Coder::template Model<4> few_;
  typename Coder::template Model<256> bytes_;
  typename Coder::template Model<516> many_;
};

TEST(ArithmeticCoder, DecodesWhatWasEncodedAndReadsAllBytes) {
  for (const int count : {0, 1, 2, 3, 10, 1000, 30000}) {
    std::mt19937_64 random(static_cast<unsigned>(count));
    Mixture<ArithmeticEncoder> encoded;
    ArithmeticEncoder encoder;
    encoder.Begin();
    std::vector<std::uint64_t> sums;
    BitModel bits;
    for (int i = 0; i < count; ++i) {
      sums.push_back(encoded.Code(encoder, random(), i));
      encoder.Bit(bits, sums.back() % 5 == 0);
    }
    const std::string bytes = "before" + encoder.Finish() + "after";
    const MemorySource source(bytes);
    ByteWindow window;
    ArithmeticDecoder decoder;
    decoder.Begin(window, source, 6, bytes.size() - 5);
    Mixture<ArithmeticDecoder> decoded;
    bits.Forget();
    for (int i = 0; i < count; ++i) {
      ASSERT_EQ(decoded.Code(decoder, 0, i), sums[static_cast<std::size_t>(i)]) << i;
      ASSERT_EQ(decoder.Bit(bits), sums[static_cast<std::size_t>(i)] % 5 == 0) << i;
    }
    EXPECT_EQ(decoder.position(), bytes.size() - 5) << count;
    EXPECT_EQ(decoder.missing(), 0u) << count;
  }
}

TEST(ArithmeticCoder, NeedsAboutTheEntropyOfTheSymbols) {
  std::mt19937 random(1);
  ArithmeticEncoder encoder;
  encoder.Begin();
  ArithmeticEncoder::Model<16> model;
  const int count = 100000;
  // Symbol 3 in 9 of 10 cases, else any of the 16.
  for (int i = 0; i < count; ++i) encoder.Symbol(model, random() % 10 < 9 ? 3 : random() % 16);
  const double often = 0.9 + 0.1 / 16, seldom = 0.1 / 16;
  const double bits = -often * std::log2(often) - 15 * seldom * std::log2(seldom);
  EXPECT_NEAR(static_cast<double>(encoder.Finish().size()), count * bits / 8, 0.01 * count * bits / 8);
}

TEST(ArithmeticCoder, CarriesIntoBytesThatAreWrittenAlready) {
  // The last symbol of a model again and again leads to the upper end of the interval, and so to runs of 0xFF.
  ArithmeticEncoder encoder;
  for (int run = 1; run < 200; ++run) {
    encoder.Begin();
    ArithmeticEncoder::Model<256> model;
    std::vector<std::uint32_t> symbols(static_cast<std::size_t>(run), 255);
    for (const std::uint32_t symbol : symbols) encoder.Symbol(model, symbol);
    encoder.Bits(32, 0xFFFFFFFF);
    const std::string bytes = encoder.Finish();
    const MemorySource source(bytes);
    ByteWindow window;
    ArithmeticDecoder decoder;
    decoder.Begin(window, source, 0, bytes.size());
    ArithmeticDecoder::Model<256> same;
    for (const std::uint32_t symbol : symbols) ASSERT_EQ(decoder.Symbol(same), symbol) << run;
    ASSERT_EQ(decoder.Bits(32), 0xFFFFFFFF) << run;
  }
}

// As in the paper: a carry looks at the bytes that are written already.
class PlainEncoder {
 public:
  void Narrow(std::uint32_t by, std::uint32_t length) {
    base_ += by;
    if (base_ < by) {
      std::size_t at = bytes_.size() - 1;
      while (bytes_[at] == '\xFF') bytes_[at--] = 0;
      ++bytes_[at];
    }
    for (length_ = length; length_ < 1u << 24; length_ <<= 8, base_ <<= 8) bytes_ += static_cast<char>(base_ >> 24);
  }
  std::uint32_t length() const { return length_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::uint32_t base_ = 0, length_ = 0xFFFFFFFF;
  std::string bytes_;
};

TEST(ArithmeticEncoder, WritesTheBytesOfAPlainEncoder) {
  std::mt19937 random(1);
  for (int run = 0; run < 300; ++run) {
    ArithmeticEncoder encoder;
    encoder.Begin();
    PlainEncoder plain;
    // The last part of the interval again and again gives long runs of 0xFF, in some of which a carry ends.
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t length = plain.length(), part = 1 + random() % (length >> random() % 16);
      const bool is_last = run % 3 > 0 && random() % 300 > 0;
      const std::uint32_t by = is_last ? length - part : random() % (length - part + 1);
      encoder.Narrow(by, part);
      plain.Narrow(by, part);
    }
    ASSERT_GT(plain.bytes().size(), 100u);
    const bool short_end = plain.length() > 1u << 25;  // As of LASzip.
    plain.Narrow(short_end ? 1u << 24 : 1u << 23, short_end ? 1u << 23 : 1u << 15);
    EXPECT_EQ(encoder.Finish(), plain.bytes() + std::string(short_end ? 3 : 2, '\0')) << run;
  }
}

TEST(ArithmeticDecoder, CountsTheBytesThatAreMissing) {
  const std::string bytes = "\x80\x40";
  const MemorySource source(bytes);
  ByteWindow window;
  ArithmeticDecoder decoder;
  decoder.Begin(window, source, 0, 2);
  EXPECT_EQ(decoder.missing(), 2u);
  decoder.Bits(32);
  EXPECT_EQ(decoder.missing(), 6u);
  EXPECT_EQ(decoder.position(), 8u);
}

class FailingSource : public ByteSource {
 public:
  std::uint64_t size() const override { return 1000; }
  absl::Status ReadAt(std::uint64_t, std::span<char>) const override { return absl::UnavailableError("no disk"); }
};

TEST(ArithmeticDecoder, KeepsTheFailureOfItsSource) {
  ByteWindow window;
  ArithmeticDecoder decoder;
  decoder.Begin(window, FailingSource(), 0, 1000);
  EXPECT_EQ(decoder.Bits(8), 0u);
  EXPECT_EQ(decoder.status(), absl::UnavailableError("no disk"));
}

}  // namespace
}  // namespace albtpu::laz
