// The LASzip record: the VLR of a LAZ file (user "laszip encoded", record 22204) that says how its points are
// compressed. Source: LASzip's public headers; M. Isenburg, "LASzip: lossless compression of lidar data", PE&RS 79(2),
// 2013. The layout of the record is in laszip_record.cc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::laz {

inline constexpr std::string_view kLaszipUser = "laszip encoded";
inline constexpr std::uint16_t kLaszipRecordId = 22204;
inline constexpr std::uint8_t kCompressedFlag = 0x80;  // Of the byte of the point format in the LAS header.

enum class Compressor : std::uint16_t {
  kPointwise = 1,         // All points in one stream.
  kPointwiseChunked = 2,  // Formats 0 to 5.
  kLayeredChunked = 3,    // Formats 6 to 10: in each chunk a stream for each field.
};

// Groups of fields that are compressed as one item.
enum class ItemType : std::uint16_t {
  kByte = 0,  // Extra bytes of formats 0 to 5.
  kPoint10 = 6,
  kGpsTime11 = 7,
  kRgb12 = 8,
  kWavePacket13 = 9,
  kPoint14 = 10,
  kRgb14 = 11,
  kRgbNir14 = 12,
  kWavePacket14 = 13,
  kByte14 = 14,  // Extra bytes of formats 6 to 10.
};

struct Item {
  ItemType type;
  std::uint16_t size;  // Bytes in a record.
  std::uint16_t version;

  bool operator==(const Item&) const = default;
};

// The chunk table states the points of each chunk.
inline constexpr std::uint32_t kVariableChunks = 0xFFFFFFFF;
inline constexpr std::uint32_t kCommonChunkSize = 50000;  // Points; LASzip's default.

struct LaszipRecord {
  Compressor compressor = Compressor::kPointwiseChunked;
  std::uint32_t chunk_size = kCommonChunkSize;  // Points, or kVariableChunks; 0 for kPointwise only.
  std::vector<Item> items;                      // In the order of their fields in a record.

  std::size_t record_length() const;  // The sum of the items' sizes.
};

// The record that this program writes for records of `record_length` bytes of point format 0 to 10: compressor 2 with
// items of version 2 (wave packets: 1) for formats 0 to 5, compressor 3 with items of version 3 for 6 to 10.
//
//   RecordFor(6, 38, kCommonChunkSize).items  // {kPoint14, 30, 3}, {kByte14, 8, 3}
//
// Requires a record length of at least that of the format, and a chunk size that is not 0.
LaszipRecord RecordFor(int point_format, std::size_t record_length, std::uint32_t chunk_size);

// Reads the data of the VLR, and checks that the decoder can read points of this format and length. InvalidArgument: a
// contradiction, which the message names ("its LASzip record states ..."). Unimplemented: a compressor, a coder or a
// version of an item that is not supported (before LASzip 2.0, items are of version 1); the message names a remedy.
absl::StatusOr<LaszipRecord> ParseLaszipRecord(std::string_view data, int point_format, std::size_t record_length);

// The data of the VLR.
std::string LaszipRecordData(const LaszipRecord& record);

}  // namespace albtpu::laz
