// Decodes the chunks of fuzz targets, which hold the decoder to its own bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "formats/laz/coding/arithmetic_decoder.h"
#include "tests/fuzz/laz/chunk_input.h"

namespace albtpu::fuzz {

struct DecodedChunk {
  absl::Status status;
  std::string records;
  std::uint64_t position = 0;  // Where the chunk ends; if all its points were decoded.
};

// Decodes `bytes` as a chunk of `points` points, of which `decoded` points become records, `step` points at a time.
// Aborts when the decoder reads bytes outside of the chunk.
DecodedChunk DecodeChunk(laz::ChunkDecoder& decoder, std::string_view bytes, std::size_t record_length,
                         std::uint64_t points, std::size_t decoded, std::size_t step, bool exact);

// Aborts unless `records` are the same after they have been encoded and decoded. Requires an encoder.
void MustSurviveCoding(ChunkCoding& coding, std::string_view records);

}  // namespace albtpu::fuzz
