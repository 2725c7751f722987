// The GPS times of points of formats 6 to 10.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "formats/laz/items/field_layers.h"
#include "formats/laz/items/gps_time_coder.h"

namespace albtpu::laz {

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
    Pass(TimeField& field, const ChannelRun& run)
        : times_(&field.channels_[run.models]), time_(field.last_[run.from]) {
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
