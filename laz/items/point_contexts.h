// What all layers need of the points of a batch, which the first layer provides: their scanner channels, which of their
// fields changed, and the models that code the other fields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace albtpu::laz {

inline constexpr int kChannels = 4;
inline constexpr std::size_t kBatchPoints = 512;  // Their records and the models of a layer stay in the L1 cache.

template <typename Number>
using BatchColumn = std::array<Number, kBatchPoints>;

// Each scanner channel has models and a last point of its own. The points of a run are coded by the models of the
// channel `models`; the first is predicted from the last point of channel `from`, each other from the point before it,
// and the last one is then the last point of channel `to`. A channel that begins takes over the last point of the
// channel before.
struct ChannelRun {
  std::size_t begin = 0, end = 0;  // Points of the batch.
  std::size_t models = 0, from = 0, to = 0;

  // True for the first point of a channel in the chunk, whose history is that of one point. Only where `to` = `models`.
  bool Begins() const { return from != models; }
};

class ChannelRuns {
 public:
  void Clear() { count_ = 0; }
  // Adds the next point of the batch.
  void Add(std::size_t point, std::size_t models, std::size_t from, std::size_t to) {
    if (count_ > 0) [[likely]] {
      ChannelRun& run = runs_[count_ - 1];
      if (models == run.models && from == run.from && to == run.to && from == to) [[likely]] {
        run.end = point + 1;
        return;
      }
    }
    runs_[count_++] = {point, point + 1, models, from, to};
  }
  const ChannelRun* begin() const { return runs_.data(); }
  const ChannelRun* end() const { return runs_.data() + count_; }

 private:
  std::array<ChannelRun, kBatchPoints> runs_;
  std::size_t count_ = 0;
};

// Bits of the symbol that states which fields differ from those of the last point of the channel. The lowest two bits
// state how the return number differs.
inline constexpr std::uint32_t kSameNumber = 0, kNextNumber = 1, kNumberBefore = 2, kOtherNumber = 3;
inline constexpr std::uint32_t kCountChanges = 1 << 2, kAngleChanges = 1 << 3, kTimeChanges = 1 << 4,
                               kSourceChanges = 1 << 5, kChannelChanges = 1 << 6;

struct PointContexts {
  ChannelRuns runs;           // Of the fields of format 6, and of all items of version 4.
  ChannelRuns version3_runs;  // Of colours, wave packets and extra bytes of version 3.

  BatchColumn<std::uint8_t> changes;    // The symbol of the constants above.
  BatchColumn<std::uint8_t> place;      // Returns::place().
  BatchColumn<std::uint8_t> level;      // ReturnLevel().
  BatchColumn<std::uint8_t> z_context;  // Of the model for the size of the difference in height.

  bool Changes(std::size_t i, std::uint32_t what) const { return (changes[i] & what) != 0; }
};

// The runs of items of version 3. By a mistake of the first implementation, which is now the format, they take part in
// a change of the channel, but fall back to channel 0 with the next point; and when the models change to a channel that
// is in use already, the last point stays that of the channel before.
class Version3Path {
 public:
  void Begin(std::uint32_t channel) {
    current_ = channel;
    used_ = 1u << channel;
  }

  // For a point that states a new `channel`, or else 0.
  void Next(std::uint32_t channel, std::size_t point, ChannelRuns& runs) {
    const std::uint32_t before = current_;
    const bool begins = (used_ >> channel & 1) == 0;
    runs.Add(point, channel, before, begins ? channel : before);
    current_ = channel;
    used_ |= 1u << channel;
  }

 private:
  std::uint32_t current_ = 0, used_ = 1;
};

// The place of an item after the first in the records of formats 6 to 10, and the prediction of its points.

struct ItemPlace {
  std::size_t offset = 0;
  bool version3 = true;  // Else 4.

  const ChannelRuns& Runs(const PointContexts& contexts) const {
    return version3 ? contexts.version3_runs : contexts.runs;
  }
};

}  // namespace albtpu::laz
