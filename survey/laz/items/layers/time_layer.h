// The layer of the GPS times of points of formats 6 to 10.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "survey/laz/items/gps_time_coder.h"
#include "survey/laz/items/layers/layers.h"
#include "survey/laz/items/layers/point14_fields.h"
#include "survey/laz/items/layers/point_contexts.h"
#include "survey/laz/items/layers/record_run.h"

namespace albtpu::laz {

template <typename Coder>
class TimeLayer final : public FieldLayer<Coder, std::int64_t, kTimeOffset> {
  using Times = GpsTimeCoder<Coder, false>;

  void Start(std::size_t channel, std::int64_t first) override {
    channels_[channel].Begin(first);
    last_.fill(first);
  }

  void CodeField(Coder& coder, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : contexts.runs) {
      Times& times = channels_[run.models];
      std::int64_t time = last_[run.from];
      if (run.Begins()) times.Begin(time);
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (contexts.Changes(i, kTimeChanges)) time = times.Code(coder, this->Known(points, i));
        this->Set(points, i, time);
      }
      last_[run.to] = time;
    }
  }

  ChannelHistories<Times> channels_;
  std::array<std::int64_t, kChannels> last_{};
};

}  // namespace albtpu::laz
