// The layer of wave packets of formats 9 and 10.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "laz/items/layers.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"
#include "laz/items/wave_packet_coder.h"

namespace albtpu::laz {

template <typename Coder>
class WavePacketLayer final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  explicit WavePacketLayer(const ItemPlace& place) : place_(place) {}

  std::size_t streams() const override { return 1; }

  void Begin(const char* first_point) override {
    channels_.ForgetAll([](WavePacketCoder<Coder>& models) { models.Forget(); });
    std::memcpy(first_.data(), first_point + place_.offset, first_.size());
    last_.fill(Packet(first_));
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    for (const ChannelRun& run : place_.Runs(contexts)) {
      WavePacketCoder<Coder>& models = channels_[run.models];
      WavePacket packet = last_[run.from];
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (streams[0].present) packet = models.Code(streams[0].coder, packet, Packet(Known(points, i)));
        if constexpr (!Coder::kEncodes) StoreWavePacket(packet, points[i] + place_.offset);
      }
      last_[run.to] = packet;
    }
  }

  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    streams[0].present |= points.Any(
        [&](const char* point) { return std::memcmp(point + place_.offset, first_.data(), first_.size()) != 0; });
  }

 private:
  using Bytes = std::array<char, kWavePacketSize>;

  static WavePacket Packet(const Bytes& bytes) { return LoadWavePacket({bytes.data(), bytes.size()}); }
  Bytes Known(const RecordRun<Coder>& points, std::size_t i) const {
    return points.template Known<Bytes>(i, place_.offset);
  }

  ItemPlace place_;
  ChannelHistories<WavePacketCoder<Coder>> channels_;
  Bytes first_{};
  std::array<WavePacket, kChannels> last_{};
};

}  // namespace albtpu::laz
