// Integers coded as their differences from a prediction: first the number of bits of the difference, then its upper
// eight bits by a model for that number, then the other bits as they are.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "laz/coding/arithmetic_decoder.h"
#include "laz/coding/arithmetic_encoder.h"
#include "laz/coding/symbol_model.h"

namespace albtpu::laz {

// For integers of `kBits` bits, 16 or 32. The contexts of one coder share the models of the upper bits.
template <typename Coder, int kBits, int kContexts>
class IntegerCoder {
 public:
  IntegerCoder() {
    for (int k = 1; k < kModelledBits; ++k) upper_[k - 1] = UpperModel(1 << k);
  }

  void Forget() {
    for (auto& model : sizes_) model.Forget();
    for (auto& model : upper_) model.Forget();
    zero_or_one_.Forget();
  }

  // Bits of the last difference; 0 for the differences 0 and 1.
  std::uint32_t size() const { return size_; }

  // Decodes an integer, or encodes `actual`; returns it.
  [[gnu::always_inline]] std::int32_t Code(Coder& coder, std::int32_t predicted, std::int32_t actual,
                                           std::uint32_t context = 0) {
    if constexpr (Coder::kEncodes) {
      Encode(coder, predicted, actual, context);
      return actual;
    } else {
      return Decode(coder, predicted, context);
    }
  }

  [[gnu::always_inline]] std::int32_t Decode(ArithmeticDecoder& decoder, std::int32_t predicted,
                                             std::uint32_t context = 0) {
    size_ = decoder.Symbol(sizes_[context]);
    std::uint32_t difference;
    if (size_ == 0) {
      difference = decoder.Bit(zero_or_one_);
    } else if (size_ < 32) {
      difference = decoder.Symbol(upper_[size_ - 1]);
      if (size_ > kModelledBits) {
        const int lower = static_cast<int>(size_) - kModelledBits;
        difference = difference << lower | decoder.Bits(lower);
      }
      // 2^size numbers: below zero down to -(2^size - 1), and above it from 2^(size-1) + 1 on.
      const std::uint32_t is_below = difference >> (size_ - 1) == 0 ? 1 : 0;
      difference += 1 - (is_below << size_);
    } else {
      difference = 1u << 31;  // The only one of 32 bits.
    }
    return Fold(static_cast<std::uint32_t>(predicted) + difference);
  }

  [[gnu::always_inline]] void Encode(ArithmeticEncoder& encoder, std::int32_t predicted, std::int32_t actual,
                                     std::uint32_t context = 0) {
    const auto difference = Signed(static_cast<std::uint32_t>(actual) - static_cast<std::uint32_t>(predicted));
    const std::uint32_t magnitude =
        difference <= 0 ? 0u - static_cast<std::uint32_t>(difference) : static_cast<std::uint32_t>(difference) - 1;
    size_ = static_cast<std::uint32_t>(std::bit_width(magnitude));
    encoder.Symbol(sizes_[context], size_);
    if (size_ == 0) {
      encoder.Bit(zero_or_one_, difference != 0);
    } else if (size_ < 32) {
      const std::uint32_t bits = static_cast<std::uint32_t>(difference) + (difference < 0 ? (1u << size_) - 1 : 0u - 1);
      const int lower = size_ > kModelledBits ? static_cast<int>(size_) - kModelledBits : 0;
      encoder.Symbol(upper_[size_ - 1], bits >> lower);
      if (lower > 0) encoder.Bits(lower, bits & ((1u << lower) - 1));
    }
  }

 private:
  static constexpr int kModelledBits = 8;
  using UpperModel = typename Coder::template Model<1 << kModelledBits>;

  // To the integers of kBits bits, as the format has them: signed for 32 bits, from 0 to 65535 for 16.
  static std::int32_t Fold(std::uint32_t sum) {
    return static_cast<std::int32_t>(kBits == 32 ? sum : sum & ((1u << (kBits % 32)) - 1));
  }
  static std::int32_t Signed(std::uint32_t difference) {
    constexpr int kUnused = 32 - kBits;
    return static_cast<std::int32_t>(difference << kUnused) >> kUnused;
  }

  std::uint32_t size_ = 0;
  std::array<typename Coder::template Model<kBits + 1>, kContexts> sizes_;
  BitModel zero_or_one_;
  std::array<UpperModel, kBits> upper_;
};

}  // namespace albtpu::laz
