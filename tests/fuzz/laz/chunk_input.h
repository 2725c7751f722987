// The input of the fuzz targets for chunks: five bytes that choose how a chunk is coded and decoded, then the chunk.
// And how it is decoded, holding the decoder to its own bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/laszip_record.h"
#include "laz/items/point_encoders.h"

namespace albtpu::fuzz {

inline constexpr std::size_t kChunkHeadSize = 5;
inline constexpr std::size_t kMostPoints = 16;  // Decoded of a chunk, so that inputs run fast.

// How the bytes of a chunk are compressed, with a decoder and an encoder that are used again from input to input.
struct ChunkCoding {
  int point_format = 0;
  laz::LaszipRecord record;
  std::unique_ptr<laz::ChunkDecoder> decoder;
  std::unique_ptr<laz::ChunkDecoder> returns_decoder;  // Of WantedFields::kReturns; only of layered chunks.
  std::unique_ptr<laz::ChunkEncoder> encoder;          // Only of what RecordFor() prescribes.
  ChunkCoding* encoded = nullptr;  // How such records are encoded: this one, or that of RecordFor().
};

struct ChunkInput {
  ChunkCoding* coding = nullptr;
  std::uint64_t points = 0;  // That the chunk is said to have, true or not.
  std::size_t decoded = 0;   // Of them, the points that are decoded.
  std::size_t step = 0;      // Points in a step of the second decoding.
  bool exact = false;        // Whether the end of the chunk is known.
  std::string_view bytes;    // Of the chunk, or records that are to be encoded.

  std::size_t record_length() const { return coding->record.record_length(); }
};

// Requires kChunkHeadSize bytes or more.
ChunkInput ParseChunkInput(std::string_view input);

// The head of an input for a chunk of other points: 1 to 240.
std::string WithPoints(std::string head, std::size_t points);

// The streams of a layered chunk. Behind its first record lie its number of points and the size of each stream, 4 bytes
// each, then the streams. 0: the chunk is not layered.
std::size_t LayerCount(const laz::LaszipRecord& record);

struct DecodedChunk {
  absl::Status status;
  std::string records;
  std::uint64_t position = 0;  // Where the chunk ends; if all its points were decoded.
};

// Decodes `bytes` as a chunk of `points` points, of which `decoded` points become records, `step` points at a time.
// Aborts when the decoder reads bytes outside of the chunk.
DecodedChunk DecodeChunk(laz::ChunkDecoder& decoder, std::string_view bytes, std::size_t record_length,
                         std::uint64_t points, std::size_t decoded, std::size_t step, bool exact);

// Aborts unless `records` are the same after they have been encoded and decoded. Requires an encoder. `known`: as for
// ChunkEncoder::Encode().
void MustSurviveCoding(ChunkCoding& coding, std::string_view records, std::span<const std::string_view> known = {});

}  // namespace albtpu::fuzz
