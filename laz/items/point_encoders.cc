// Chooses decoder and encoder by the LASzip record.
#include "laz/items/point_encoders.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "laz/coding/little_endian.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/point_contexts.h"

namespace albtpu::laz {
void PointwiseEncoder::Encode(std::string_view records, std::string& chunk,
                              [[maybe_unused]] std::span<const std::string_view> known) {
  assert(known.empty());
  assert(!records.empty() && records.size() % record_length_ == 0);
  chunk.assign(records.substr(0, record_length_));
  items_.Begin(records.data());
  encoder_.Begin();
  ArithmeticEncoder encoder = std::move(encoder_);  // Its state stays in registers here.
  for (std::size_t i = record_length_; i < records.size(); i += record_length_)
    items_.Code(encoder, records.data() + i);
  encoder.Finish(chunk);
  encoder_ = std::move(encoder);
}

namespace {

// Of points, or of bytes of a layer.
void StoreCount(std::size_t count, char* destination) {
  const auto stored = static_cast<std::uint32_t>(count);
  assert(stored == count);
  Store(stored, destination);
}

}  // namespace

LayeredEncoder::LayeredEncoder(const LaszipRecord& record) : point_(record), record_length_(record.record_length()) {}

void LayeredEncoder::Encode(std::string_view records, std::string& chunk, std::span<const std::string_view> known) {
  assert(!records.empty() && records.size() % record_length_ == 0);
  const std::size_t points = records.size() / record_length_;
  const RecordRun<ArithmeticEncoder> further(records.data() + record_length_, record_length_, points - 1);
  point_.Begin(records.data());
  point_.FindChanges(further, known.size());
  for (auto& stream : point_.streams()) stream.coder.Begin();
  for (std::size_t i = 0; i < further.count(); i += kBatchPoints)
    point_.Code({further[i], record_length_, std::min(kBatchPoints, further.count() - i)}, known.size());

  chunk.assign(records.substr(0, record_length_));
  chunk.resize(record_length_ + (1 + point_.streams().size()) * sizeof(std::uint32_t));
  StoreCount(points, &chunk[record_length_]);
  std::size_t size_offset = record_length_ + sizeof(std::uint32_t);
  for (std::size_t i = 0; i < point_.streams().size(); ++i) {
    auto& stream = point_.streams()[i];
    const std::size_t begin = chunk.size();
    if (i < known.size())
      chunk.append(known[i]);
    else if (stream.present)
      stream.coder.Finish(chunk);
    StoreCount(chunk.size() - begin, &chunk[size_offset]);
    size_offset += sizeof(std::uint32_t);
  }
}

CommonLayers::CommonLayers(const LaszipRecord& from, const LaszipRecord& to) {
  if (from.compressor != Compressor::kLayeredChunked || to.compressor != Compressor::kLayeredChunked) return;
  const auto without_bytes = [](LaszipRecord record) {
    std::erase_if(record.items, [](const Item& item) { return item.type == ItemType::kByte14; });
    return record;
  };
  const LaszipRecord common = without_bytes(from);
  if (common.items != without_bytes(to).items) return;
  const auto layers = [](const LaszipRecord& record) {
    return LayeredPoint<ArithmeticDecoder>(record).streams().size();
  };
  count_ = layers(common);
  sizes_begin_ = from.record_length() + sizeof(std::uint32_t);
  begin_ = sizes_begin_ + layers(from) * sizeof(std::uint32_t);
}

std::vector<std::string_view> CommonLayers::Of(std::string_view chunk) const {
  if (chunk.size() < begin_) return {};
  std::vector<std::string_view> layers;
  std::size_t begin = begin_;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto size = Load<std::uint32_t>(chunk, sizes_begin_ + i * sizeof(std::uint32_t));
    if (size > chunk.size() - begin || (i == 0 && size == 0)) return {};
    layers.push_back(chunk.substr(begin, size));
    begin += size;
  }
  return layers;
}

std::unique_ptr<ChunkDecoder> ChunkDecoder::For(const LaszipRecord& record, WantedFields wanted) {
  if (record.compressor == Compressor::kLayeredChunked) return std::make_unique<LayeredDecoder>(record, wanted);
  return std::make_unique<PointwiseDecoder>(record);
}

std::unique_ptr<ChunkEncoder> ChunkEncoder::For(const LaszipRecord& record) {
  if (record.compressor == Compressor::kLayeredChunked) return std::make_unique<LayeredEncoder>(record);
  return std::make_unique<PointwiseEncoder>(record);
}

}  // namespace albtpu::laz
