// The encoder of the layers of extra bytes: eight at a time, in the lanes of vectors. Its bytes are those of
// ExtraBytesLayers<ArithmeticEncoder>.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "laz/coding/arithmetic_encoder.h"
#include "laz/items/byte_lanes.h"
#include "laz/items/layers.h"
#include "laz/items/point_contexts.h"

namespace albtpu::laz {

class ExtraBytesEncoder final : public Layers<ArithmeticEncoder> {
 public:
  ExtraBytesEncoder(const ItemPlace& place, std::size_t bytes) : place_(place), bytes_(bytes) {}

  std::size_t streams() const override { return bytes_; }
  void Begin(const char* first_point) override;
  void Code(Streams streams, const RecordRun<ArithmeticEncoder>& points, const PointContexts& contexts) override;
  void FindChanges(Streams streams, const RecordRun<ArithmeticEncoder>& points) const override;

 private:
  // Layers that are coded together.
  struct Group {
    LaneWindow window;
    std::array<std::size_t, kByteLanes> streams{};
    std::size_t count = 0;                                              // Of streams.
    std::array<std::array<char, LaneWindow::kSize>, kChannels> last{};  // The window of the last point of a channel.
    ChannelHistories<ByteLaneModels> models;
  };

  // Distributes the streams that are present to groups.
  void MakeGroups(Streams streams);
  void CodeGroup(Group& group, Streams streams, const RecordRun<ArithmeticEncoder>& points, const ChannelRuns& runs);

  ItemPlace place_;
  std::size_t bytes_;
  std::string first_point_;
  std::size_t group_count_ = 0;                     // 0: groups are to be made.
  std::vector<std::unique_ptr<Group>> groups_;      // Those behind group_count_ keep their memory for later chunks.
  std::array<ArithmeticEncoder, kByteLanes> idle_;  // Of lanes without a stream.
};

}  // namespace albtpu::laz
