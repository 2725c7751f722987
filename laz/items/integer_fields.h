// The fields of points of formats 6 to 10 that are coded as integers (heights, intensities, scan angles, point sources,
// GPS times), and the kinds of returns that choose their contexts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "laz/coding/integer_coder.h"
#include "laz/items/field_layers.h"
#include "laz/items/gps_time_coder.h"

namespace albtpu::laz {

// The kinds of returns by which the layers of formats 6 to 10 choose contexts: a return is predicted from earlier ones
// of its kind.

// Both are from 0 to 15 and need not be plausible: files have return 0, or more returns than there are.
struct Returns {
  std::uint8_t number = 0;  // Of this return in its pulse.
  std::uint8_t count = 0;   // Of all returns of the pulse.

  static Returns From(std::uint8_t byte) {
    return {static_cast<std::uint8_t>(byte & 15), static_cast<std::uint8_t>(byte >> 4)};
  }
  std::uint8_t byte() const { return static_cast<std::uint8_t>(count << 4 | number); }

  // 1: the first of its pulse; 2: the last; 3: the only one; 0: between.
  std::uint32_t place() const { return (number == 1 ? 1u : 0u) | (number >= count ? 2u : 0u); }
  std::uint32_t is_alone() const { return count == 1 ? 1u : 0u; }
};

inline constexpr int kReturnKinds = 6;
inline constexpr int kReturnLevels = 8;

// The kind of a return, which correlates with the distance of the previous point: [count][number], prescribed by the
// format.
inline constexpr std::array<std::array<std::uint8_t, 16>, 16> kReturnKind = {{
    {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
    {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
    {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
    {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5},
}};

inline std::uint32_t ReturnKind(Returns returns) { return kReturnKind[returns.count][returns.number]; }

// How many returns of the pulse follow, at most 7: returns of a level have similar heights.
inline std::uint32_t ReturnLevel(Returns returns) {
  const int level = std::abs(int{returns.count} - int{returns.number});
  return static_cast<std::uint32_t>(level < kReturnLevels ? level : kReturnLevels - 1);
}

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
      return previous_ = last = static_cast<std::uint16_t>(history_->intensities.Code(coder, last, known, place));
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

// The GPS times of points of formats 6 to 10.

template <typename Coder>
class TimeField : public PlainField<std::int64_t, kTimeOffset> {
  using Times = GpsTimeCoder<Coder, false>;

 public:
  void Start(std::size_t channel, std::int64_t first) {
    channels_[channel].Begin(first);
    last_.fill(first);
  }

  class Pass {
   public:
    Pass(TimeField& field, const ChannelRun& run) : times_(&field.channels_[run.models]), time_(field.last_[run.from]) {
      if (run.Begins()) times_->Begin(time_);
    }
    [[gnu::always_inline]] std::int64_t Code(Coder& coder, const PointContexts& contexts, std::size_t i,
                                             std::int64_t known) {
      if (contexts.Changes(i, kTimeChanges)) time_ = times_->Code(coder, known);
      return time_;
    }
    void End(TimeField& field, const ChannelRun& run) const { field.last_[run.to] = time_; }

   private:
    Times* times_;
    std::int64_t time_;
  };

 private:
  ChannelHistories<Times> channels_;
  std::array<std::int64_t, kChannels> last_{};
};

}  // namespace albtpu::laz
