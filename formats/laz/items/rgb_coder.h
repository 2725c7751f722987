// Colours, coded byte by byte: which bytes changed, and by how much. Green follows red, and blue follows both.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace albtpu::laz {

using Rgb = std::array<std::uint8_t, 6>;  // As in a record: red, green, blue, each low byte first.

template <typename Coder>
class RgbCoder {
 public:
  void Forget() {
    changes_.Forget();
    for (auto& model : differences_) model.Forget();
  }

  // Decodes the colour that follows `last`, or encodes `rgb`; returns it.
  [[gnu::always_inline]] Rgb Code(Coder& coder, const Rgb& last, Rgb rgb) {
    const std::uint32_t changes = coder.Symbol(changes_, Coder::kEncodes ? Changes(last, rgb) : 0);
    const auto code = [&](std::size_t byte, int predicted) __attribute__((always_inline)) {
      if (changes >> byte & 1) {
        const auto difference = static_cast<std::uint8_t>(rgb[byte] - predicted);
        rgb[byte] = static_cast<std::uint8_t>(predicted +
                                              static_cast<int>(coder.Symbol(differences_[byte], difference)));
      } else {
        rgb[byte] = last[byte];
      }
    };
    code(0, last[0]);
    code(1, last[1]);
    if ((changes & kNotGrey) == 0) return {rgb[0], rgb[1], rgb[0], rgb[1], rgb[0], rgb[1]};
    for (std::size_t i = 0; i < 2; ++i) {
      const int red = rgb[i] - last[i];
      code(2 + i, std::clamp(last[2 + i] + red, 0, 255));
      const int green = rgb[2 + i] - last[2 + i];
      code(4 + i, std::clamp(last[4 + i] + (red + green) / 2, 0, 255));
    }
    return rgb;
  }

 private:
  static constexpr std::uint32_t kNotGrey = 1u << 6;

  static std::uint32_t Changes(const Rgb& last, const Rgb& rgb) {
    std::uint32_t changes = 0;
    for (std::size_t i = 0; i < 6; ++i) changes |= std::uint32_t{rgb[i] != last[i]} << i;
    const bool grey = rgb[2] == rgb[0] && rgb[3] == rgb[1] && rgb[4] == rgb[0] && rgb[5] == rgb[1];
    return grey ? changes : changes | kNotGrey;
  }

  typename Coder::template Model<128> changes_;
  std::array<typename Coder::template Model<256>, 6> differences_;
};

}  // namespace albtpu::laz
