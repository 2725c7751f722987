// Decodes the chunks of compressor 3: formats 6 to 10, with a stream for each field. A chunk is
//
//   the first point                as in a LAS file
//   u32                            the number of points
//   u32 for each layer             its size; 0: the field is the same in all points
//   the layers
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "formats/laz/coding/arithmetic_decoder.h"
#include "formats/laz/items/chunk_decoder.h"
#include "formats/laz/items/laszip_record.h"
#include "formats/laz/items/layered_point.h"

namespace albtpu::laz {

class LayeredDecoder : public ChunkDecoder {
 public:
  explicit LayeredDecoder(const LaszipRecord& record, WantedFields wanted = WantedFields::kAll);

  absl::Status Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                     std::uint64_t points) override;
  absl::Status Decode(std::span<char> records) override;
  absl::Status End(bool exact) override;
  std::uint64_t position() const override { return layers_end_; }

 private:
  absl::Status CheckStreams();

  LayeredPoint<ArithmeticDecoder> point_;
  WantedFields wanted_;
  std::size_t record_length_;
  std::vector<char> head_;                  // The bytes before the layers.
  std::vector<ByteWindow> windows_;         // Of each stream.
  std::vector<std::uint64_t> stream_ends_;  // In the source.
  std::size_t piece_size_;                  // Bytes of each layer in memory.
  std::uint64_t layers_end_ = 0, end_ = 0;
  bool first_is_next_ = false;
};

}  // namespace albtpu::laz
