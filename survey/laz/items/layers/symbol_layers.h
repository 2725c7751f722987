// The layers of points of formats 6 to 10 that code symbols: classes, flags and user data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "survey/laz/items/layers/layers.h"
#include "survey/laz/items/layers/point14_fields.h"
#include "survey/laz/items/layers/point_contexts.h"
#include "survey/laz/items/layers/record_run.h"

namespace albtpu::laz {

// The models of a field in each scanner channel, one for each of 64 circumstances.
template <typename Coder, int kSymbols>
class SymbolModels {
 public:
  using Model = typename Coder::template Model<kSymbols>;

  void Forget() {
    channels_.ForgetAll([](auto& models) {
      for (Model& model : models) model.Forget();
    });
  }
  std::array<Model, 64>& operator[](std::size_t channel) { return channels_[channel]; }

 private:
  ChannelHistories<std::array<Model, 64>> channels_;
};

// A byte that is coded as it is, by a model for the last one.
template <typename Coder, std::size_t kOffset, typename Circumstance>
class ByteLayer final : public FieldLayer<Coder, std::uint8_t, kOffset> {
  void Start(std::size_t /*channel*/, std::uint8_t first) override {
    models_.Forget();
    last_.fill(first);
  }

  void CodeField(Coder& coder, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : contexts.runs) {
      auto& models = models_[run.models];
      std::uint8_t byte = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        auto& model = models[Circumstance()(byte, contexts.place[i])];
        byte = static_cast<std::uint8_t>(coder.Symbol(model, this->Known(points, i)));
        this->Set(points, i, byte);
      }
      last_[run.to] = byte;
    }
  }

  SymbolModels<Coder, 256> models_;
  std::array<std::uint8_t, kChannels> last_{};
};

// By the last class, and whether the return is the only one of its pulse.
struct ClassCircumstance {
  std::size_t operator()(std::uint8_t last, std::uint8_t place) const {
    return (last & 31u) << 1 | (place == 3);
  }
};
struct UserDataCircumstance {
  std::size_t operator()(std::uint8_t last, std::uint8_t /*place*/) const { return last / 4u; }
};

template <typename Coder>
using ClassLayer = ByteLayer<Coder, kClassOffset, ClassCircumstance>;
template <typename Coder>
using UserDataLayer = ByteLayer<Coder, kUserDataOffset, UserDataCircumstance>;

// The flags by the last ones. Sets the scanner channel too, which lies in the same byte.
template <typename Coder>
class FlagsLayer final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  std::size_t streams() const override { return 1; }

  void Begin(const char* first_point) override {
    models_.Forget();
    first_ = PointFlags(static_cast<std::uint8_t>(first_point[kFlagsOffset]));
    last_.fill(first_);
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    Coder coder = std::move(streams[0].coder);
    for (const ChannelRun& run : contexts.runs) {
      auto& models = models_[run.models];
      std::uint32_t flags = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (streams[0].present) flags = coder.Symbol(models[flags], Known(points, i));
        points.Set(i, kFlagsOffset, FlagsByte(flags, static_cast<std::uint32_t>(run.models)));
      }
      last_[run.to] = flags;
    }
    streams[0].coder = std::move(coder);
  }

  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    bool changes = false;
    for (std::size_t i = 0; i < points.count(); ++i) changes |= Known(points, i) != first_;
    streams[0].present |= changes;
  }

 private:
  static std::uint32_t Known(const RecordRun<Coder>& points, std::size_t i) {
    return PointFlags(points.template Known<std::uint8_t>(i, kFlagsOffset));
  }

  SymbolModels<Coder, 64> models_;
  std::uint32_t first_ = 0;
  std::array<std::uint32_t, kChannels> last_{};
};

}  // namespace albtpu::laz
