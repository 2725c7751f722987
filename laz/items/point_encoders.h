// The compressed bytes of a chunk, from its points: the interface, and its two implementations for formats 0 to 5 and 6
// to 10.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

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

  // Compresses `records`, one point or more, into `chunk`, whose contents it replaces.
  virtual void Encode(std::string_view records, std::string& chunk) = 0;
};

// The compressed bytes of a chunk of points of formats 0 to 5.
class PointwiseEncoder : public ChunkEncoder {
 public:
  explicit PointwiseEncoder(const LaszipRecord& record) : record_length_(record.record_length()), items_(record) {}

  void Encode(std::string_view records, std::string& chunk) override;

 private:
  std::size_t record_length_;
  PointwiseItems<ArithmeticEncoder> items_;
  ArithmeticEncoder encoder_;
};

// Encodes the chunks of compressor 3; LayeredDecoder (chunk_decoder.h) describes their parts.

class LayeredEncoder : public ChunkEncoder {
 public:
  explicit LayeredEncoder(const LaszipRecord& record);
  void Encode(std::string_view records, std::string& chunk) override;

 private:
  LayeredPoint<ArithmeticEncoder> point_;
  std::size_t record_length_;
};

}  // namespace albtpu::laz
