// The layers of the extra bytes of formats 6 to 10: one for each byte, which is coded as its difference from the last.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "laz/items/layers.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"

namespace albtpu::laz {

template <typename Coder>
class ExtraBytesLayers final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  ExtraBytesLayers(const ItemPlace& place, std::size_t bytes) : place_(place), bytes_(bytes) {}

  std::size_t streams() const override { return bytes_.size(); }

  void Begin(const char* first_point) override {
    for (std::size_t b = 0; b < bytes_.size(); ++b) {
      bytes_[b].models.ForgetAll([](Model& model) { model.Forget(); });
      bytes_[b].first = static_cast<std::uint8_t>(first_point[place_.offset + b]);
      bytes_[b].last.fill(bytes_[b].first);
    }
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    std::size_t b = 0;
    for (; b + 4 <= bytes_.size(); b += 4) CodeBytes<4>(streams, b, points, place_.Runs(contexts));
    for (; b < bytes_.size(); ++b) CodeBytes<1>(streams, b, points, place_.Runs(contexts));
  }

  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    for (std::size_t b = 0; b < bytes_.size(); ++b) {
      const std::size_t offset = place_.offset + b;
      const auto differs = [&](const char* point) {
        return static_cast<std::uint8_t>(point[offset]) != bytes_[b].first;
      };
      streams[b].present |= points.Any(differs);
    }
  }

 private:
  using Model = typename Coder::template Model<256>;

  struct Byte {
    ChannelHistories<Model> models;
    std::array<std::uint8_t, kChannels> last{};
    std::uint8_t first = 0;
  };

  // Codes bytes point after point: a processor works on some streams at a time, which do not depend on each other.
  template <std::size_t kCount>
  void CodeBytes(Streams streams, std::size_t first, const RecordRun<Coder>& points, const ChannelRuns& runs) {
    LayerStream<Coder>* const stream = &streams[first];
    Byte* const bytes = &bytes_[first];
    auto coders = [stream]<std::size_t... b>(std::index_sequence<b...>) {
      return std::array<Coder, kCount>{std::move(stream[b].coder)...};
    }
    (std::make_index_sequence<kCount>());
    for (const ChannelRun& run : runs) {
      std::array<Model*, kCount> models{};
      std::array<std::uint8_t, kCount> last;
      for (std::size_t b = 0; b < kCount; ++b) {
        if (stream[b].present) models[b] = &bytes[b].models[run.models];
        last[b] = bytes[b].last[run.from];
      }
      for (std::size_t i = run.begin; i < run.end; ++i) {
        auto next = points.template Known<std::array<std::uint8_t, kCount>>(i, place_.offset + first);
        for (std::size_t b = 0; b < kCount; ++b) {
          const auto difference = static_cast<std::uint8_t>(next[b] - last[b]);
          next[b] = last[b];
          if (stream[b].present)
            next[b] = static_cast<std::uint8_t>(last[b] + coders[b].Symbol(*models[b], difference));
        }
        last = next;
        points.Set(i, place_.offset + first, next);
      }
      for (std::size_t b = 0; b < kCount; ++b) bytes[b].last[run.to] = last[b];
    }
    for (std::size_t b = 0; b < kCount; ++b) stream[b].coder = std::move(coders[b]);
  }

  ItemPlace place_;
  std::vector<Byte> bytes_;
};

}  // namespace albtpu::laz
