// The layers of colours of formats 7, 8 and 10: red, green and blue in one stream, near infrared in another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "laz/items/layers.h"
#include "laz/items/point_contexts.h"
#include "laz/items/pointwise_items.h"
#include "laz/items/record_run.h"

namespace albtpu::laz {

template <typename Coder>
class RgbLayer final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  explicit RgbLayer(const ItemPlace& place) : place_(place) {}

  std::size_t streams() const override { return 1; }

  void Begin(const char* first_point) override {
    channels_.ForgetAll([](RgbCoder<Coder>& models) { models.Forget(); });
    std::memcpy(first_.data(), first_point + place_.offset, first_.size());
    last_.fill(first_);
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    Coder coder = std::move(streams[0].coder);
    for (const ChannelRun& run : place_.Runs(contexts)) {
      RgbCoder<Coder>& models = channels_[run.models];
      Rgb rgb = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (streams[0].present) rgb = models.Code(coder, rgb, Known(points, i));
        points.Set(i, place_.offset, rgb);
      }
      last_[run.to] = rgb;
    }
    streams[0].coder = std::move(coder);
  }

  // LASzip keeps the stream also where a colour that is not grey is the same everywhere.
  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    const bool grey = first_ == Rgb{first_[0], first_[1], first_[0], first_[1], first_[0], first_[1]};
    streams[0].present |= points.Any([&](const char* point) {
      return !grey || std::memcmp(point + place_.offset, first_.data(), first_.size()) != 0;
    });
  }

 private:
  Rgb Known(const RecordRun<Coder>& points, std::size_t i) const {
    return points.template Known<Rgb>(i, place_.offset);
  }

  ItemPlace place_;
  ChannelHistories<RgbCoder<Coder>> channels_;
  Rgb first_{};
  std::array<Rgb, kChannels> last_{};
};

// Which of the two bytes changed, and by how much.
template <typename Coder>
class InfraredLayer final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  explicit InfraredLayer(const ItemPlace& place) : place_(place) {}

  std::size_t streams() const override { return 1; }

  void Begin(const char* first_point) override {
    channels_.ForgetAll([](Models& models) {
      models.changes.Forget();
      for (auto& model : models.differences) model.Forget();
    });
    std::memcpy(first_.data(), first_point + place_.offset, first_.size());
    last_.fill(first_);
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    Coder coder = std::move(streams[0].coder);
    for (const ChannelRun& run : place_.Runs(contexts)) {
      Models& models = channels_[run.models];
      Bytes bytes = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (streams[0].present) bytes = CodeBytes(coder, models, bytes, Known(points, i));
        points.Set(i, place_.offset, bytes);
      }
      last_[run.to] = bytes;
    }
    streams[0].coder = std::move(coder);
  }

  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    streams[0].present |= points.Any(
        [&](const char* point) { return std::memcmp(point + place_.offset, first_.data(), first_.size()) != 0; });
  }

 private:
  using Bytes = std::array<std::uint8_t, 2>;
  struct Models {
    typename Coder::template Model<4> changes;
    std::array<typename Coder::template Model<256>, 2> differences;
  };

  [[gnu::always_inline]] static Bytes CodeBytes(Coder& coder, Models& models, const Bytes& last, const Bytes& known) {
    const std::uint32_t changes =
        coder.Symbol(models.changes, (known[0] != last[0] ? 1u : 0u) | (known[1] != last[1] ? 2u : 0u));
    Bytes bytes = last;
    for (std::size_t i = 0; i < 2; ++i) {
      if ((changes >> i & 1) == 0) continue;
      const auto difference = static_cast<std::uint8_t>(known[i] - last[i]);
      bytes[i] = static_cast<std::uint8_t>(last[i] + coder.Symbol(models.differences[i], difference));
    }
    return bytes;
  }

  Bytes Known(const RecordRun<Coder>& points, std::size_t i) const {
    return points.template Known<Bytes>(i, place_.offset);
  }

  ItemPlace place_;
  ChannelHistories<Models> channels_;
  Bytes first_{};
  std::array<Bytes, kChannels> last_{};
};

}  // namespace albtpu::laz
