// The compressed bytes of a chunk, from its points: the interface, and its two implementations for formats 0 to 5 and 6
// to 10.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laz/coding/arithmetic_encoder.h"
#include "laz/items/laszip_record.h"
#include "laz/items/layered_point.h"
#include "laz/items/pointwise_items.h"

namespace albtpu::laz {

// The compressed bytes of a chunk, from its points.

// Encodes one chunk after the other; the memory for the models is used again.
class ChunkEncoder {
 public:
  // For a record by RecordFor().
  static std::unique_ptr<ChunkEncoder> For(const LaszipRecord& record);
  virtual ~ChunkEncoder() = default;

  // Compresses `records`, one point or more, into `chunk`, whose contents it replaces. `known`: the bytes of its first
  // layers, by CommonLayers, which are not encoded again.
  virtual void Encode(std::string_view records, std::string& chunk, std::span<const std::string_view> known) = 0;
};

// Two chunks may have the same points, but for their extra bytes. Then the layers of all other fields are the same, and
// one chunk can take them over from the other.
class CommonLayers {
 public:
  // For chunks that are compressed by the record `from`, and by `to`. Formats 0 to 5 have no layers; items that differ
  // have none in common.
  CommonLayers(const LaszipRecord& from, const LaszipRecord& to);
  bool empty() const { return count_ == 0; }

  // The bytes of these layers in a chunk that is compressed by `from`. Requires that there are some. The result is
  // empty if the layers do not fit into the chunk, or if the first layer is missing: LASzip does not read such a chunk.
  std::vector<std::string_view> Of(std::string_view chunk) const;

 private:
  std::size_t count_ = 0;
  std::size_t sizes_begin_ = 0, begin_ = 0;  // Where a chunk has the sizes of its layers, and the layers.
};

// The compressed bytes of a chunk of points of formats 0 to 5.
class PointwiseEncoder : public ChunkEncoder {
 public:
  explicit PointwiseEncoder(const LaszipRecord& record) : record_length_(record.record_length()), items_(record) {}

  void Encode(std::string_view records, std::string& chunk, std::span<const std::string_view> known) override;

 private:
  std::size_t record_length_;
  PointwiseItems<ArithmeticEncoder> items_;
  ArithmeticEncoder encoder_;
};

// Encodes the chunks of compressor 3; LayeredDecoder (chunk_decoder.h) describes their parts.

class LayeredEncoder : public ChunkEncoder {
 public:
  explicit LayeredEncoder(const LaszipRecord& record);
  void Encode(std::string_view records, std::string& chunk, std::span<const std::string_view> known) override;

 private:
  LayeredPoint<ArithmeticEncoder> point_;
  std::size_t record_length_;
};

}  // namespace albtpu::laz
