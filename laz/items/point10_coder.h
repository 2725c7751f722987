// The fields common to point formats 0 to 5 and the contexts of their returns. Coded are which fields changed, then the
// changed ones, then the coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "laz/coding/integer_coder.h"
#include "laz/items/streaming_median.h"

namespace albtpu::laz {

// Classes of similar points of formats 0 to 5, by their return number r of n returns: the contexts in which LASzip
// predicts intensities and coordinates, for all numbers of three bits, plausible or not.

struct Point10Context {
  std::uint8_t returns;  // Of 16: the possible pairs (r, n) up to n = 5 in their order, further ones among them.
  std::uint8_t level;    // |n - r|: how many returns lie below.
  bool single;           // n = 1.
};

inline constexpr std::size_t kReturnContexts = 16, kLevels = 8;

// By the low six bits of the byte that has r in bits 0 to 2 and n in bits 3 to 5.
inline constexpr std::array<Point10Context, 64> kPoint10Contexts = [] {
  constexpr std::array<std::array<std::uint8_t, 8>, 8> kReturns = {{{15, 14, 13, 12, 11, 10, 9, 8},
                                                                    {14, 0, 1, 3, 6, 10, 10, 9},
                                                                    {13, 1, 2, 4, 7, 11, 11, 10},
                                                                    {12, 3, 4, 5, 8, 12, 12, 11},
                                                                    {11, 6, 7, 8, 9, 13, 13, 12},
                                                                    {10, 10, 11, 12, 13, 14, 14, 13},
                                                                    {9, 10, 11, 12, 13, 14, 15, 14},
                                                                    {8, 9, 10, 11, 12, 13, 14, 15}}};
  std::array<Point10Context, 64> contexts{};
  for (std::size_t n = 0; n < 8; ++n)
    for (std::size_t r = 0; r < 8; ++r)
      contexts[n << 3 | r] = {kReturns[n][r], static_cast<std::uint8_t>(n > r ? n - r : r - n), n == 1};
  return contexts;
}();

// As in a record.
struct Point10 {
  std::int32_t x, y, z;
  std::uint16_t intensity;
  // Return number: bits 0-2; number of returns: 3-5; scan direction: 6; edge of line: 7.
  std::uint8_t returns;
  std::uint8_t classification, scan_angle, user_data;
  std::uint16_t source;
};
static_assert(sizeof(Point10) == 20);

template <typename Coder>
class Point10Coder {
 public:
  // Begins anew after the first point.
  void Begin(const Point10& first) {
    last_ = first;
    last_.intensity = 0;
    intensity_.fill(0);
    z_.fill(0);
    x_steps_.fill({});
    y_steps_.fill({});
    changes_.Forget();
    for (auto* const models : {&returns_, &classifications_, &user_data_})
      for (auto& model : *models) model.Forget();
    for (auto& model : scan_angles_) model.Forget();
    intensities_.Forget();
    sources_.Forget();
    dx_.Forget();
    dy_.Forget();
    dz_.Forget();
  }

  // Decodes the next point, or encodes `point`; returns it.
  [[gnu::always_inline]] Point10 Code(Coder& coder, Point10 point) {
    const std::uint32_t changes = coder.Symbol(changes_, Coder::kEncodes ? Changes(point) : 0);
    if (changes != 0)
      CodeChanges(coder, changes, point);
    else if (!Coder::kEncodes)
      point = last_;
    const Point10Context context = ContextOf(point.returns);

    StreamingMedian& x_steps = x_steps_[context.returns];
    const std::int32_t x_step = dx_.Code(coder, x_steps.median(), Minus(point.x, last_.x), context.single);
    x_steps.Add(x_step);

    StreamingMedian& y_steps = y_steps_[context.returns];
    const std::uint32_t y_context = context.single + Even(std::min(dx_.size(), kMaxSizeForY));
    const std::int32_t y_step = dy_.Code(coder, y_steps.median(), Minus(point.y, last_.y), y_context);
    y_steps.Add(y_step);

    std::int32_t& z = z_[context.level];
    const std::uint32_t z_context = context.single + Even(std::min((dx_.size() + dy_.size()) / 2, kMaxSizeForZ));
    z = dz_.Code(coder, z, point.z, z_context);

    point.x = Plus(last_.x, x_step);
    point.y = Plus(last_.y, y_step);
    point.z = z;
    last_ = point;
    return point;
  }

 private:
  enum : std::uint32_t {
    kSourceChanged = 1 << 0,
    kUserDataChanged = 1 << 1,
    kScanAngleChanged = 1 << 2,
    kClassificationChanged = 1 << 3,
    kIntensityChanged = 1 << 4,
    kReturnsChanged = 1 << 5,
  };
  static constexpr std::uint32_t kMaxSizeForY = 20, kMaxSizeForZ = 18;
  static constexpr std::uint32_t kIntensityContexts = 4;

  static Point10Context ContextOf(std::uint8_t returns) { return kPoint10Contexts[returns & 63]; }
  static std::uint32_t Even(std::uint32_t number) { return number & ~1u; }
  static std::int32_t Minus(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
  }
  static std::int32_t Plus(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  }

  // The intensity is compared to that of the last point of the same returns, which is 0 at first; the others to the
  // point before.
  std::uint32_t Changes(const Point10& point) const {
    const auto if_changed = [](auto last, auto now, std::uint32_t bit) { return last != now ? bit : 0; };
    return if_changed(last_.source, point.source, kSourceChanged) |
           if_changed(last_.user_data, point.user_data, kUserDataChanged) |
           if_changed(last_.scan_angle, point.scan_angle, kScanAngleChanged) |
           if_changed(last_.classification, point.classification, kClassificationChanged) |
           if_changed(intensity_[ContextOf(point.returns).returns], point.intensity, kIntensityChanged) |
           if_changed(last_.returns, point.returns, kReturnsChanged);
  }

  [[gnu::always_inline]] void CodeChanges(Coder& coder, std::uint32_t changes, Point10& point) {
    const auto code_byte = [&](auto& models, std::uint8_t last, std::uint8_t now) {
      return static_cast<std::uint8_t>(coder.Symbol(models[last], now));
    };
    point.returns = changes & kReturnsChanged ? code_byte(returns_, last_.returns, point.returns) : last_.returns;
    const std::uint32_t context = ContextOf(point.returns).returns;
    std::uint16_t& intensity = intensity_[context];
    if (changes & kIntensityChanged) {
      intensity = static_cast<std::uint16_t>(
          intensities_.Code(coder, intensity, point.intensity, std::min(context, kIntensityContexts - 1)));
    }
    point.intensity = intensity;
    point.classification = changes & kClassificationChanged
                               ? code_byte(classifications_, last_.classification, point.classification)
                               : last_.classification;
    if (changes & kScanAngleChanged) {
      const auto step = static_cast<std::uint8_t>(point.scan_angle - last_.scan_angle);
      point.scan_angle =
          static_cast<std::uint8_t>(last_.scan_angle + coder.Symbol(scan_angles_[point.returns >> 6 & 1], step));
    } else {
      point.scan_angle = last_.scan_angle;
    }
    point.user_data =
        changes & kUserDataChanged ? code_byte(user_data_, last_.user_data, point.user_data) : last_.user_data;
    point.source = changes & kSourceChanged
                       ? static_cast<std::uint16_t>(sources_.Code(coder, last_.source, point.source))
                       : last_.source;
  }

  Point10 last_{};
  std::array<std::uint16_t, kReturnContexts> intensity_{};
  std::array<std::int32_t, kLevels> z_{};
  std::array<StreamingMedian, kReturnContexts> x_steps_, y_steps_;

  using ByteModel = typename Coder::template Model<256>;
  typename Coder::template Model<64> changes_;
  IntegerCoder<Coder, 32, 2> dx_;
  IntegerCoder<Coder, 32, kMaxSizeForY + 2> dy_;
  IntegerCoder<Coder, 32, kMaxSizeForZ + 2> dz_;
  IntegerCoder<Coder, 16, kIntensityContexts> intensities_;
  IntegerCoder<Coder, 16, 1> sources_;
  std::array<ByteModel, 2> scan_angles_;                              // By scan direction.
  std::array<ByteModel, 256> returns_, classifications_, user_data_;  // By the byte of the point before.
};

}  // namespace albtpu::laz
