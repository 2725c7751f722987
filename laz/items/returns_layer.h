// The first layer of points of formats 6 to 10: their scanner channel, which of their fields changed, their return, x
// and y. It is always present, and determines the contexts of all other layers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "laz/coding/integer_coder.h"
#include "laz/items/integer_fields.h"
#include "laz/items/layers.h"
#include "laz/items/point14_fields.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"
#include "laz/items/streaming_median.h"

namespace albtpu::laz {

template <typename Coder>
class ReturnsLayer {
 public:
  // Begins a chunk after its first point.
  void Begin(const char* first_point) {
    channels_.ForgetAll([](Channel& channel) { channel.Forget(); });
    current_ = ScannerChannel(static_cast<std::uint8_t>(first_point[kFlagsOffset]));
    used_ = 1u << current_;
    version3_path_.Begin(current_);
    channels_[current_].Start(LastPoint::From(first_point));
  }

  // Codes at most kBatchPoints points, and fills the contexts of all other layers.
  void Code(Coder& coder, const RecordRun<Coder>& points, PointContexts& contexts) {
    contexts.runs.Clear();
    contexts.version3_runs.Clear();
    Coder local = std::move(coder);  // Its state stays in registers here.
    for (std::size_t i = 0; i < points.count(); ++i) CodePoint(local, points, i, contexts);
    coder = std::move(local);
  }

  // Replaces Code() if the bytes of this layer are known. Fills the runs of the contexts, which extra bytes need.
  void Follow(const RecordRun<Coder>& points, PointContexts& contexts) {
    contexts.runs.Clear();
    contexts.version3_runs.Clear();
    for (std::size_t i = 0; i < points.count(); ++i) {
      const std::uint32_t before = current_;
      current_ = ScannerChannel(static_cast<std::uint8_t>(points[i][kFlagsOffset]));
      AddToRuns(i, before, current_ != before ? current_ : 0, contexts);
    }
  }

 private:
  struct LastPoint {
    std::int32_t x = 0, y = 0;
    Returns returns;
    bool time_changed = false;
    // Only encoders know these.
    std::uint64_t time = 0;
    std::uint16_t angle = 0, source = 0;

    static LastPoint From(const char* point) {
      LastPoint last;
      std::memcpy(&last.x, point + kXOffset, sizeof last.x);
      std::memcpy(&last.y, point + kYOffset, sizeof last.y);
      std::memcpy(&last.time, point + kTimeOffset, sizeof last.time);
      std::memcpy(&last.angle, point + kAngleOffset, sizeof last.angle);
      std::memcpy(&last.source, point + kSourceOffset, sizeof last.source);
      last.returns = Returns::From(static_cast<std::uint8_t>(point[kReturnsOffset]));
      return last;
    }
  };

  struct Channel {
    struct Steps {
      StreamingMedian x, y;
    };

    LastPoint last;
    std::array<Steps, 2 * kReturnKinds> steps;  // By the kind of the return, and whether the time changed.
    std::array<typename Coder::template Model<128>, 8> changes;
    typename Coder::template Model<kChannels - 1> channel;
    std::array<typename Coder::template Model<16>, 16> counts, numbers;  // By the last one.
    typename Coder::template Model<13> number_steps;
    IntegerCoder<Coder, 32, 2> x;
    IntegerCoder<Coder, 32, 22> y;

    void Forget() {
      for (auto& model : changes) model.Forget();
      channel.Forget();
      for (auto& model : counts) model.Forget();
      for (auto& model : numbers) model.Forget();
      number_steps.Forget();
      x.Forget();
      y.Forget();
    }

    void Start(const LastPoint& first) {
      steps = {};
      last = first;
    }
  };

  [[gnu::always_inline]] void CodePoint(Coder& coder, const RecordRun<Coder>& points, std::size_t i,
                                        PointContexts& contexts) {
    const std::uint32_t before = current_;
    Channel& old = channels_[before];
    std::uint32_t changes = 0, announced = 0;
    if constexpr (Coder::kEncodes) changes = Changes(points[i]);
    changes = coder.Symbol(old.changes[old.last.returns.place() | (old.last.time_changed ? 4 : 0)], changes);
    if ((changes & kChannelChanges) != 0) [[unlikely]]
      announced = current_ = CodeChannel(coder, old, points.template Known<std::uint8_t>(i, kFlagsOffset));
    Channel& channel = channels_[current_];
    const bool begins = (used_ >> current_ & 1) == 0;
    if (begins) [[unlikely]]
      channel.Start(old.last);

    LastPoint& last = channel.last;
    const bool time_changes = (changes & kTimeChanges) != 0;
    const Returns returns =
        CodeReturns(coder, channel, changes, Returns::From(points.template Known<std::uint8_t>(i, kReturnsOffset)));
    const std::uint32_t alone = returns.is_alone();
    auto& steps = channel.steps[ReturnKind(returns) << 1 | (time_changes ? 1 : 0)];
    last.x = CodeStep(coder, channel.x, steps.x, last.x, points.template Known<std::int32_t>(i, kXOffset), alone);
    const std::uint32_t x_size = channel.x.size();
    last.y = CodeStep(coder, channel.y, steps.y, last.y, points.template Known<std::int32_t>(i, kYOffset),
                      alone | std::min(x_size & ~1u, 20u));
    const std::uint32_t size = (x_size + channel.y.size()) / 2;
    last.returns = returns;
    last.time_changed = time_changes;
    if constexpr (Coder::kEncodes) {
      last.time = points.template Known<std::uint64_t>(i, kTimeOffset);
      last.angle = points.template Known<std::uint16_t>(i, kAngleOffset);
      last.source = points.template Known<std::uint16_t>(i, kSourceOffset);
    }
    points.Set(i, kXOffset, last.x);
    points.Set(i, kYOffset, last.y);
    points.Set(i, kReturnsOffset, returns.byte());

    AddToRuns(i, before, announced, contexts);
    contexts.changes[i] = static_cast<std::uint8_t>(changes);
    contexts.place[i] = static_cast<std::uint8_t>(returns.place());
    contexts.level[i] = static_cast<std::uint8_t>(ReturnLevel(returns));
    contexts.z_context[i] = static_cast<std::uint8_t>(alone | std::min(size & ~1u, 18u));
  }

  // `before`: the channel of the point before. `announced`: the new channel, or else 0.
  void AddToRuns(std::size_t i, std::uint32_t before, std::uint32_t announced, PointContexts& contexts) {
    const bool begins = (used_ >> current_ & 1) == 0;
    used_ |= 1u << current_;
    contexts.runs.Add(i, current_, begins ? before : current_, current_);
    version3_path_.Next(announced, i, contexts.version3_runs);
  }

  // The symbol for a point that is to be encoded.
  std::uint32_t Changes(const char* point) {
    const LastPoint next = LastPoint::From(point);
    const std::uint32_t channel = ScannerChannel(static_cast<std::uint8_t>(point[kFlagsOffset]));
    const LastPoint& last = channels_[(used_ >> channel & 1) != 0 ? channel : current_].last;
    const std::uint32_t step = (next.returns.number - last.returns.number) & 15u;
    return (step == 0    ? kSameNumber
            : step == 1  ? kNextNumber
            : step == 15 ? kNumberBefore
                         : kOtherNumber) |
           (next.returns.count != last.returns.count ? kCountChanges : 0) |
           (next.angle != last.angle ? kAngleChanges : 0) | (next.time != last.time ? kTimeChanges : 0) |
           (next.source != last.source ? kSourceChanges : 0) | (channel != current_ ? kChannelChanges : 0);
  }

  // The new channel: 1 to 3 channels further.
  std::uint32_t CodeChannel(Coder& coder, Channel& old, std::uint8_t flags_byte) {
    const std::uint32_t step = (ScannerChannel(flags_byte) - current_ - 1) % kChannels;
    return (current_ + 1 + coder.Symbol(old.channel, step)) % kChannels;
  }

  static Returns CodeReturns(Coder& coder, Channel& channel, std::uint32_t changes, Returns known) {
    const Returns last = channel.last.returns;
    std::uint32_t count = last.count, number = last.number;
    if ((changes & kCountChanges) != 0) count = coder.Symbol(channel.counts[count], known.count);
    switch (changes & 3) {
      case kSameNumber:
        break;
      case kNextNumber:
        number += 1;
        break;
      case kNumberBefore:
        number += 15;
        break;
      case kOtherNumber:
        if ((changes & kTimeChanges) != 0)
          number = coder.Symbol(channel.numbers[number], known.number);
        else
          number += 2 + coder.Symbol(channel.number_steps, (known.number - number - 2) & 15);
    }
    return {static_cast<std::uint8_t>(number & 15), static_cast<std::uint8_t>(count)};
  }

  // Codes a coordinate as its step from the last one, which is near the median of recent steps. Returns the coordinate.
  template <typename Integers>
  [[gnu::always_inline]] static std::int32_t CodeStep(Coder& coder, Integers& integers, StreamingMedian& steps,
                                                      std::int32_t last, std::int32_t known, std::uint32_t context) {
    const auto difference = [](std::int32_t a, std::int32_t b) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
    };
    const std::int32_t step = integers.Code(coder, steps.median(), difference(known, last), context);
    steps.Add(step);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(last) + static_cast<std::uint32_t>(step));
  }

  ChannelHistories<Channel> channels_;
  std::uint32_t current_ = 0, used_ = 1;  // Channels; those with points, as bits.
  Version3Path version3_path_;
};

}  // namespace albtpu::laz
