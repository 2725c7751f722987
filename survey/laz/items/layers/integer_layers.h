// The layers of points of formats 6 to 10 that code integers: heights, intensities, scan angles and point sources.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "survey/laz/coding/integer_coder.h"
#include "survey/laz/items/layers/layers.h"
#include "survey/laz/items/layers/point14_fields.h"
#include "survey/laz/items/layers/point_contexts.h"
#include "survey/laz/items/layers/record_run.h"
#include "survey/laz/items/layers/return_contexts.h"

namespace albtpu::laz {

// Predicts each height from the last one of the same level of returns.
template <typename Coder>
class HeightLayer final : public FieldLayer<Coder, std::int32_t, kZOffset> {
  struct History {
    std::array<std::int32_t, kReturnLevels> last;
    IntegerCoder<Coder, 32, 20> heights;
  };

  void Start(std::size_t channel, std::int32_t first) override {
    channels_.ForgetAll([](History& history) { history.heights.Forget(); });
    channels_[channel].last.fill(first);
    previous_ = first;
  }

  void CodeField(Coder& coder, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : contexts.runs) {
      History& history = channels_[run.models];
      if (run.Begins()) history.last.fill(previous_);
      for (std::size_t i = run.begin; i < run.end; ++i) {
        std::int32_t& last = history.last[contexts.level[i]];
        previous_ = last = history.heights.Code(coder, last, this->Known(points, i), contexts.z_context[i]);
        this->Set(points, i, last);
      }
    }
  }

  ChannelHistories<History> channels_;
  std::int32_t previous_ = 0;
};

// Predicts each intensity from the last one of a return at the same place in its pulse.
template <typename Coder>
class IntensityLayer final : public FieldLayer<Coder, std::uint16_t, kIntensityOffset> {
  struct History {
    std::array<std::uint16_t, 8> last;  // By the place of the return, and whether the time changed.
    IntegerCoder<Coder, 16, 4> intensities;
  };

  void Start(std::size_t channel, std::uint16_t first) override {
    channels_.ForgetAll([](History& history) { history.intensities.Forget(); });
    channels_[channel].last.fill(first);
    previous_ = first;
  }

  void CodeField(Coder& coder, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : contexts.runs) {
      History& history = channels_[run.models];
      if (run.Begins()) history.last.fill(previous_);
      for (std::size_t i = run.begin; i < run.end; ++i) {
        const std::uint32_t place = contexts.place[i];
        std::uint16_t& last = history.last[place << 1 | (contexts.Changes(i, kTimeChanges) ? 1 : 0)];
        last =
            static_cast<std::uint16_t>(history.intensities.Code(coder, last, this->Known(points, i), place));
        previous_ = last;
        this->Set(points, i, last);
      }
    }
  }

  ChannelHistories<History> channels_;
  std::uint16_t previous_ = 0;
};

// A field that is coded where the symbol of kChange says that it differs from that of the last point. `kByTime`: those
// of pulses have a context of their own beside those of further returns.
template <typename Coder, std::size_t kOffset, std::uint32_t kChange, bool kByTime>
class ChangeLayer final : public FieldLayer<Coder, std::uint16_t, kOffset> {
  struct History {
    IntegerCoder<Coder, 16, kByTime ? 2 : 1> numbers;
  };

  void Start(std::size_t /*channel*/, std::uint16_t first) override {
    channels_.ForgetAll([](History& history) { history.numbers.Forget(); });
    last_.fill(first);
  }

  void CodeField(Coder& coder, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : contexts.runs) {
      auto& numbers = channels_[run.models].numbers;
      std::uint16_t number = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (contexts.Changes(i, kChange)) {
          const std::uint32_t context = kByTime && contexts.Changes(i, kTimeChanges) ? 1 : 0;
          number = static_cast<std::uint16_t>(numbers.Code(coder, number, this->Known(points, i), context));
        }
        this->Set(points, i, number);
      }
      last_[run.to] = number;
    }
  }

  ChannelHistories<History> channels_;
  std::array<std::uint16_t, kChannels> last_{};
};

template <typename Coder>
using AngleLayer = ChangeLayer<Coder, kAngleOffset, kAngleChanges, true>;
template <typename Coder>
using SourceLayer = ChangeLayer<Coder, kSourceOffset, kSourceChanges, false>;

}  // namespace albtpu::laz
