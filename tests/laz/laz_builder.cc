#include "tests/laz/laz_builder.h"

#include <algorithm>
#include <functional>
#include <string_view>

#include "laz/items/point_encoders.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::testing {

LazParts CompressPoints(int point_format, std::size_t record_length, const std::string& records,
                        const std::vector<std::size_t>& chunk_points) {
  const bool constant =
      std::adjacent_find(chunk_points.begin(), chunk_points.end(), std::not_equal_to<>()) == chunk_points.end();
  LazParts parts;
  parts.record = laz::RecordFor(point_format, record_length,
                                !constant              ? laz::kVariableChunks
                                : chunk_points.empty() ? laz::kCommonChunkSize
                                                       : static_cast<std::uint32_t>(chunk_points[0]));
  parts.records = records;
  const auto encoder = laz::ChunkEncoder::For(parts.record);
  std::size_t begin = 0;
  for (std::size_t i = 0; begin < records.size(); ++i) {
    const std::size_t left = records.size() - begin;
    const std::size_t size = i < chunk_points.size() ? std::min(left, chunk_points[i] * record_length) : left;
    encoder->Encode(std::string_view(records).substr(begin, size), parts.chunks.emplace_back(), {});
    parts.table.push_back({.bytes = parts.chunks.back().size(), .points = size / record_length});
    begin += size;
  }
  return parts;
}

LazParts TruePoints(int point_format, std::size_t extra_bytes, std::size_t count,
                    const std::vector<std::size_t>& chunk_points) {
  LasSpec spec;
  spec.point_format = point_format;
  spec.extra_bytes = extra_bytes;
  for (int i = 0; i < static_cast<int>(count); ++i)
    spec.points.push_back({.x = 1000 + 30 * i, .y = i % 1000 * (i % 1000), .z = i % 5, .gps_time = i / 2 * 0.1});
  const std::string file = BuildLas(spec);
  const std::size_t length = PointSize(point_format) + extra_bytes;
  return CompressPoints(point_format, length, file.substr(file.size() - count * length), chunk_points);
}

std::string PointsSection(const LazParts& parts, std::uint64_t points_begin) {
  std::string chunks;
  for (const std::string& chunk : parts.chunks) chunks += chunk;
  const std::uint64_t table_offset = points_begin + sizeof table_offset + chunks.size();
  return std::string(reinterpret_cast<const char*>(&table_offset), sizeof table_offset) + chunks +
         laz::ChunkTableBytes(parts.record, parts.table);
}

}  // namespace albtpu::testing
