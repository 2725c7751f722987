// A point of formats 6 to 10 as layers, which are coded batch by batch: the first layer determines the contexts of all
// others.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "laz/items/color_layers.h"
#include "laz/items/extra_bytes_encoder.h"
#include "laz/items/extra_bytes_layers.h"
#include "laz/items/field_layers.h"
#include "laz/items/integer_fields.h"
#include "laz/items/laszip_record.h"
#include "laz/items/layers.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"
#include "laz/items/returns_layer.h"
#include "laz/items/symbol_fields.h"
#include "laz/items/wave_packet_layer.h"

namespace albtpu::laz {

template <typename Coder>
class LayeredPoint {
 public:
  // Requires items of which kPoint14 is the first.
  explicit LayeredPoint(const LaszipRecord& record) {
    assert(!record.items.empty() && record.items[0].type == ItemType::kPoint14);
    std::size_t offset = 0;
    for (const Item& item : record.items) {
      AddLayers(item, offset);
      offset += item.size;
    }
    std::size_t streams = 1;
    for (const auto& layers : layers_) streams += layers->streams();
    streams_ = std::vector<LayerStream<Coder>>(streams);
  }

  // In the order of the file.
  std::span<LayerStream<Coder>> streams() { return streams_; }

  // Whether the stream has coordinates, returns and scanner channels, classes, flags or times.
  static bool TellsReturns(std::size_t stream) { return stream <= 3 || stream == 8; }

  // Begins a chunk after its first point.
  void Begin(const char* first_point) {
    returns_.Begin(first_point);
    for (const auto& layers : layers_) layers->Begin(first_point);
  }

  // Codes points by the streams that are present. The first `known` streams are left out: 0, or all of some items.
  void Code(const RecordRun<Coder>& points, std::size_t known = 0) {
    if (known == 0)
      returns_.Code(streams_[0].coder, points, contexts_);
    else
      returns_.Follow(points, contexts_);
    ForEachLayers(known, [&](Layers<Coder>& layers, auto streams) { layers.Code(streams, points, contexts_); });
  }

  // Sets which streams behind the first `known` ones are needed for the points of a chunk after the first. LASzip
  // always has the first two.
  void FindChanges(const RecordRun<Coder>& points, std::size_t known) {
    for (auto& stream : streams_) stream.present = false;
    streams_[0].present = streams_[1].present = true;
    ForEachLayers(known, [&](Layers<Coder>& layers, auto streams) { layers.FindChanges(streams, points); });
  }

 private:
  // Calls function(layers, streams) for all layers but the first and those of the `known` streams.
  template <typename Function>
  void ForEachLayers(std::size_t known, const Function& function) {
    std::size_t stream = 1;
    for (const auto& layers : layers_) {
      if (stream >= known) function(*layers, streams().subspan(stream, layers->streams()));
      stream += layers->streams();
    }
  }

  using ExtraBytes = std::conditional_t<Coder::kEncodes, ExtraBytesEncoder, ExtraBytesLayers<Coder>>;

  template <template <typename> typename Layer, typename... Arguments>
  void Add(Arguments&&... arguments) {
    layers_.push_back(std::make_unique<Layer<Coder>>(arguments...));
  }

  template <template <typename> typename... Fields>
  void AddFields() {
    layers_.push_back(std::make_unique<FieldLayers<Coder, Fields<Coder>...>>());
  }

  void AddLayers(const Item& item, std::size_t offset) {
    const ItemPlace place = {.offset = offset, .version3 = item.version < 4};
    switch (item.type) {
      case ItemType::kPoint14:
        AddFields<HeightField, ClassField, FlagsField,
                  IntensityField>();  // Stream 1: TellsReturns() counts them.
        AddFields<AngleField, UserDataField, SourceField, TimeField>();
        break;
      case ItemType::kRgb14:
        Add<RgbLayer>(place);
        break;
      case ItemType::kRgbNir14:
        Add<RgbLayer>(place);
        Add<InfraredLayer>(ItemPlace{.offset = offset + std::tuple_size_v<Rgb>, .version3 = place.version3});
        break;
      case ItemType::kWavePacket14:
        Add<WavePacketLayer>(place);
        break;
      case ItemType::kByte14:
        layers_.push_back(std::make_unique<ExtraBytes>(place, item.size));
        break;
      default:
        assert(false && "items of formats 0 to 5 have no layers");
    }
  }

  ReturnsLayer<Coder> returns_;
  std::vector<std::unique_ptr<Layers<Coder>>> layers_;
  std::vector<LayerStream<Coder>> streams_;
  PointContexts contexts_;
};

}  // namespace albtpu::laz
