// The places of the chunks of a LAZ file: the table after its points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/items/laszip_record.h"

namespace albtpu::laz {

struct Chunk {
  std::uint64_t offset = 0, bytes = 0;  // In the file.
  std::uint64_t points = 0;

  bool operator==(const Chunk&) const = default;
};

struct ChunkTable {
  std::vector<Chunk> chunks;
  std::uint64_t begin = 0, end = 0;  // Of the table itself, in the file.
  bool offset_at_end = false;        // Its offset is in the last 8 bytes of the file, as in those written to a pipe.
};

// Bytes before the first chunk: the offset of the table.
inline constexpr std::uint64_t kTableOffsetSize = 8;

// Reads the table of a file whose points (the offset of the table, the chunks, the table) begin at `points_begin`.
// Files that were written to a pipe have offset -1 or 0 there, and the true one in their last 8 bytes.
//
// NotFound: the file has no table; its chunks must be read one after the other. DataLoss: the table contradicts the
// file, its chunks do not lie one after the other between the points' begin and the table, or do not have `point_count`
// points in all. Memory is proportional to the size of the file, whatever the table states.
absl::StatusOr<ChunkTable> ReadChunkTable(const ByteSource& file, const LaszipRecord& record,
                                          std::uint64_t points_begin, std::uint64_t point_count);

// The bytes of the table. `chunks` need only have bytes and, for kVariableChunks, points.
std::string ChunkTableBytes(const LaszipRecord& record, const std::vector<Chunk>& chunks);

}  // namespace albtpu::laz
