// The points of a chunk, from its compressed bytes: the interface, and its two implementations for formats 0 to 5 and 6
// to 10.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/items/laszip_record.h"
#include "laz/items/layered_point.h"
#include "laz/items/pointwise_items.h"

namespace albtpu::laz {

// Which fields of points are decoded. Fields that are left out have, in all points of a chunk, the values of its first
// point; damage in their layers goes unnoticed. Only layered chunks can leave fields out: others have all of them.
enum class WantedFields {
  kAll,
  kReturns,  // The place and time of each return: coordinates, returns, channels, classes, flags and GPS times.
};

// Decodes one chunk after the other; the memory for the models (some hundred kB to few MB) is used again. A chunk is
// decoded in as many steps as the caller likes, so that memory does not grow with its points.
//
//   const std::unique_ptr<ChunkDecoder> decoder = ChunkDecoder::For(record);
//   status = decoder->Begin(file, chunk.offset, chunk.offset + chunk.bytes, chunk.points);
//   std::vector<char> records(chunk.points * record.record_length());
//   status = decoder->Decode(records);
//   status = decoder->End(true);
class ChunkDecoder {
 public:
  // For any record that ParseLaszipRecord() returns.
  static std::unique_ptr<ChunkDecoder> For(const LaszipRecord& record, WantedFields wanted = WantedFields::kAll);
  virtual ~ChunkDecoder() = default;

  // Begins a chunk of `points` > 0 points in the bytes from `begin`, at most to `end`, of `source`, which must outlive
  // the decoding. DataLoss: the chunk contradicts itself: another number of points, layers that do not end in it.
  virtual absl::Status Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                             std::uint64_t points) = 0;

  // The next points: as many as fit. Requires a multiple of the record length, and no more points than are left.
  // DataLoss: the bytes ended before the points.
  virtual absl::Status Decode(std::span<char> records) = 0;

  // After the last point. DataLoss: bytes were missing or, where the end of the chunk is known (`exact`), some remain.
  // Then position() is where the chunk ends.
  virtual absl::Status End(bool exact) = 0;
  virtual std::uint64_t position() const = 0;
};

// The points of a chunk of formats 0 to 5: the first one uncompressed, the others in a single stream.

class PointwiseDecoder : public ChunkDecoder {
 public:
  explicit PointwiseDecoder(const LaszipRecord& record) : record_length_(record.record_length()), items_(record) {}

  absl::Status Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end, std::uint64_t points) override;
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

// Decodes the chunks of compressor 3: formats 6 to 10, with a stream for each field. A chunk is
//
//   the first point                as in a LAS file
//   u32                            the number of points
//   u32 for each layer             its size; 0: the field is the same in all points
//   the layers

class LayeredDecoder : public ChunkDecoder {
 public:
  explicit LayeredDecoder(const LaszipRecord& record, WantedFields wanted = WantedFields::kAll);

  absl::Status Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end, std::uint64_t points) override;
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
