// A layer of a chunk: the stream of one field of all its points but the first, which lies there as it is.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "laz/items/point14_fields.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"

namespace albtpu::laz {

template <typename Coder>
struct LayerStream {
  Coder coder;
  bool present = false;  // Absent when the field is the same in all points of the chunk.
};

// One layer, or several that are coded in one loop. `Coder` is ArithmeticDecoder or ArithmeticEncoder.
template <typename Coder>
class Layers {
 public:
  using Streams = std::span<LayerStream<Coder>>;

  virtual ~Layers() = default;
  virtual std::size_t streams() const = 0;

  // Begins a chunk after its first point.
  virtual void Begin(const char* first_point) = 0;

  // Codes the fields of at most kBatchPoints points. A decoder sets the fields of absent streams too.
  virtual void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) = 0;

  // For an encoder, before the points are coded: sets which streams are needed for these of them, beside those that
  // are present already.
  virtual void FindChanges(Streams streams, const RecordRun<Coder>& points) const = 0;
};

// The state of a stream for each scanner channel. Allocated when a channel is first used, and reused in later chunks.
template <typename History>
class ChannelHistories {
 public:
  // Calls forget(history) on all.
  template <typename Forget>
  void ForgetAll(const Forget& forget) {
    for (const auto& history : histories_)
      if (history != nullptr) forget(*history);
  }

  History& operator[](std::size_t channel) {
    if (histories_[channel] == nullptr) [[unlikely]]
      histories_[channel] = std::make_unique<History>();
    return *histories_[channel];
  }

 private:
  std::array<std::unique_ptr<History>, kChannels> histories_;
};

}  // namespace albtpu::laz
