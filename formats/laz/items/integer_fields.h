// The fields of points of formats 6 to 10 that are coded as integers: heights, intensities, scan angles and point
// sources.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "formats/laz/coding/integer_coder.h"
#include "formats/laz/items/field_layers.h"
#include "formats/laz/items/return_contexts.h"

namespace albtpu::laz {

// Predicts each height from the last one of the same level of returns.
template <typename Coder>
class HeightField : public PlainField<std::int32_t, kZOffset> {
  struct History {
    std::array<std::int32_t, kReturnLevels> last;
    IntegerCoder<Coder, 32, 20> heights;
  };

 public:
  void Start(std::size_t channel, std::int32_t first) {
    channels_.ForgetAll([](History& history) { history.heights.Forget(); });
    channels_[channel].last.fill(first);
    previous_ = first;
  }

  class Pass {
   public:
    Pass(HeightField& field, const ChannelRun& run)
        : history_(&field.channels_[run.models]), previous_(field.previous_) {
      if (run.Begins()) history_->last.fill(previous_);
    }
    [[gnu::always_inline]] std::int32_t Code(Coder& coder, const PointContexts& contexts, std::size_t i,
                                             std::int32_t known) {
      std::int32_t& last = history_->last[contexts.level[i]];
      return previous_ = last = history_->heights.Code(coder, last, known, contexts.z_context[i]);
    }
    void End(HeightField& field, const ChannelRun& /*run*/) const { field.previous_ = previous_; }

   private:
    History* history_;
    std::int32_t previous_;
  };

 private:
  ChannelHistories<History> channels_;
  std::int32_t previous_ = 0;
};

// Predicts each intensity from the last one of a return at the same place in its pulse.
template <typename Coder>
class IntensityField : public PlainField<std::uint16_t, kIntensityOffset> {
  struct History {
    std::array<std::uint16_t, 8> last;  // By the place of the return, and whether the time changed.
    IntegerCoder<Coder, 16, 4> intensities;
  };

 public:
  void Start(std::size_t channel, std::uint16_t first) {
    channels_.ForgetAll([](History& history) { history.intensities.Forget(); });
    channels_[channel].last.fill(first);
    previous_ = first;
  }

  class Pass {
   public:
    Pass(IntensityField& field, const ChannelRun& run)
        : history_(&field.channels_[run.models]), previous_(field.previous_) {
      if (run.Begins()) history_->last.fill(previous_);
    }
    [[gnu::always_inline]] std::uint16_t Code(Coder& coder, const PointContexts& contexts, std::size_t i,
                                              std::uint16_t known) {
      const std::uint32_t place = contexts.place[i];
      std::uint16_t& last = history_->last[place << 1 | (contexts.Changes(i, kTimeChanges) ? 1 : 0)];
      return previous_ = last =
                 static_cast<std::uint16_t>(history_->intensities.Code(coder, last, known, place));
    }
    void End(IntensityField& field, const ChannelRun& /*run*/) const { field.previous_ = previous_; }

   private:
    History* history_;
    std::uint16_t previous_;
  };

 private:
  ChannelHistories<History> channels_;
  std::uint16_t previous_ = 0;
};

// A field that is coded where the symbol of kChange says that it differs from that of the last point. `kByTime`: those
// of pulses have a context of their own beside those of further returns.
template <typename Coder, std::size_t kOffset, std::uint32_t kChange, bool kByTime>
class ChangingField : public PlainField<std::uint16_t, kOffset> {
  using Numbers = IntegerCoder<Coder, 16, kByTime ? 2 : 1>;

 public:
  void Start(std::size_t /*channel*/, std::uint16_t first) {
    channels_.ForgetAll([](Numbers& numbers) { numbers.Forget(); });
    last_.fill(first);
  }

  class Pass {
   public:
    Pass(ChangingField& field, const ChannelRun& run)
        : numbers_(&field.channels_[run.models]), number_(field.last_[run.from]) {}
    [[gnu::always_inline]] std::uint16_t Code(Coder& coder, const PointContexts& contexts, std::size_t i,
                                              std::uint16_t known) {
      if (contexts.Changes(i, kChange)) {
        const std::uint32_t context = kByTime && contexts.Changes(i, kTimeChanges) ? 1 : 0;
        number_ = static_cast<std::uint16_t>(numbers_->Code(coder, number_, known, context));
      }
      return number_;
    }
    void End(ChangingField& field, const ChannelRun& run) const { field.last_[run.to] = number_; }

   private:
    Numbers* numbers_;
    std::uint16_t number_;
  };

 private:
  ChannelHistories<Numbers> channels_;
  std::array<std::uint16_t, kChannels> last_{};
};

template <typename Coder>
using AngleField = ChangingField<Coder, kAngleOffset, kAngleChanges, true>;
template <typename Coder>
using SourceField = ChangingField<Coder, kSourceOffset, kSourceChanges, false>;

}  // namespace albtpu::laz
