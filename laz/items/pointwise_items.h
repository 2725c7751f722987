// The fields of points of formats 0 to 5, in the order of the record, colours among them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

#include "laz/items/gps_time_coder.h"
#include "laz/items/laszip_record.h"
#include "laz/items/point10_coder.h"
#include "laz/items/wave_packet_coder.h"

namespace albtpu::laz {

// Colours, coded byte by byte: which bytes changed, and by how much. Green follows red, and blue follows both.

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
        rgb[byte] =
            static_cast<std::uint8_t>(predicted + static_cast<int>(coder.Symbol(differences_[byte], difference)));
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

template <typename Coder>
class PointwiseItems {
 public:
  explicit PointwiseItems(const LaszipRecord& record) {
    for (const Item& item : record.items) {
      if (item.type == ItemType::kGpsTime11) time_.emplace();
      if (item.type == ItemType::kRgb12) rgb_.emplace();
      if (item.type == ItemType::kWavePacket13) wave_packet_.emplace();
      if (item.type == ItemType::kByte) extra_.resize(item.size);
    }
  }

  // Begins anew after the first record of a chunk.
  void Begin(const char* record) {
    point_.Begin(Take<Point10>(record));
    if (time_) time_->Begin(Take<std::int64_t>(record));
    if (rgb_) {
      rgb_->Forget();
      last_rgb_ = Take<Rgb>(record);
    }
    if (wave_packet_) {
      wave_packet_->Forget();
      last_wave_packet_ = LoadWavePacket({record, kWavePacketSize});
      record += kWavePacketSize;
    }
    for (ExtraByte& extra : extra_) {
      extra.model.Forget();
      extra.last = Take<std::uint8_t>(record);
    }
  }

  using Record = std::conditional_t<Coder::kEncodes, const char*, char*>;

  // Encodes a record, or decodes the next one into it.
  [[gnu::always_inline]] void Code(Coder& coder, Record record) {
    Put(record, point_.Code(coder, Known<Point10>(record)));
    if (time_) Put(record, time_->Code(coder, Known<std::int64_t>(record)));
    if (rgb_) Put(record, last_rgb_ = rgb_->Code(coder, last_rgb_, Known<Rgb>(record)));
    if (wave_packet_) {
      WavePacket packet;
      if constexpr (Coder::kEncodes) packet = LoadWavePacket({record, kWavePacketSize});
      last_wave_packet_ = wave_packet_->Code(coder, last_wave_packet_, packet);
      if constexpr (!Coder::kEncodes) StoreWavePacket(last_wave_packet_, record);
      record += kWavePacketSize;
    }
    for (ExtraByte& extra : extra_) {
      const auto step = static_cast<std::uint8_t>(Known<std::uint8_t>(record) - extra.last);
      extra.last = static_cast<std::uint8_t>(extra.last + coder.Symbol(extra.model, step));
      Put(record, extra.last);
    }
  }

 private:
  struct ExtraByte {
    std::uint8_t last = 0;
    typename Coder::template Model<256> model;
  };

  template <typename Field>
  static Field Take(const char*& record) {
    Field field;
    std::memcpy(&field, record, sizeof field);
    record += sizeof field;
    return field;
  }

  // The field that is encoded; anything when decoding.
  template <typename Field>
  static Field Known(const char* record) {
    if constexpr (Coder::kEncodes) return Take<Field>(record);
    return Field{};
  }

  template <typename Field>
  static void Put(Record& record, const Field& field) {
    if constexpr (!Coder::kEncodes) std::memcpy(record, &field, sizeof field);
    record += sizeof field;
  }

  Point10Coder<Coder> point_;
  std::optional<GpsTimeCoder<Coder, true>> time_;
  std::optional<RgbCoder<Coder>> rgb_;
  std::optional<WavePacketCoder<Coder>> wave_packet_;
  std::vector<ExtraByte> extra_;
  Rgb last_rgb_{};
  WavePacket last_wave_packet_;
};

}  // namespace albtpu::laz
