// The points of a chunk of formats 0 to 5: the first one uncompressed, the others in a single stream.
#pragma once

#include <memory>

#include "formats/laz/coding/arithmetic_decoder.h"
#include "formats/laz/items/chunk_decoder.h"
#include "formats/laz/items/pointwise_items.h"

namespace albtpu::laz {

class PointwiseDecoder : public ChunkDecoder {
 public:
  explicit PointwiseDecoder(const LaszipRecord& record)
      : record_length_(record.record_length()), items_(record) {}

  absl::Status Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                     std::uint64_t points) override;
  absl::Status Decode(std::span<char> records) override;
  absl::Status End(bool exact) override;
  std::uint64_t position() const override { return decoder_.position(); }

 private:
  absl::Status CheckBytes() const;

  std::size_t record_length_;
  std::uint64_t begin_ = 0, end_ = 0;  // Of the chunk.
  std::vector<char> first_;            // The first record, until it is read.
  PointwiseItems<ArithmeticDecoder> items_;
  ByteWindow window_;
  ArithmeticDecoder decoder_;
};

}  // namespace albtpu::laz
