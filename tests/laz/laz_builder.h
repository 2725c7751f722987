// Compresses points for tests, in parts that can be changed before they are put together: files that lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "laz/chunk_table.h"
#include "laz/items/laszip_record.h"

namespace albtpu::testing {

// The compressed points of a file, in parts.
struct LazParts {
  laz::LaszipRecord record;
  std::string records;              // The points, as they were before they were compressed.
  std::vector<std::string> chunks;  // Their compressed bytes.
  std::vector<laz::Chunk> table;    // What the table states; of each chunk, bytes and points.

  std::uint64_t point_count() const { return records.size() / record.record_length(); }
};

// Compresses records; `chunk_points` have the points of each chunk but the last, which has the rest.
LazParts CompressPoints(int point_format, std::size_t record_length, const std::string& records,
                        const std::vector<std::size_t>& chunk_points);

// `count` points on a curve, of which every two have the same time, in such chunks.
LazParts TruePoints(int point_format, std::size_t extra_bytes, std::size_t count,
                    const std::vector<std::size_t>& chunk_points);

// The offset of the table, the chunks, and the table.
std::string PointsSection(const LazParts& parts, std::uint64_t points_begin);

}  // namespace albtpu::testing
