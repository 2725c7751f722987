// Arbitrary bytes as a LAZ file are rejected with a reason; or their points, decoded by the chunk table, are those that
// are read front to back, and nothing beyond the file is asked for.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "formats/las/las_reader.h"
#include "formats/laz/chunk_table.h"
#include "formats/laz/items/chunk_decoder.h"
#include "formats/laz/laz_points.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"

namespace {

using namespace albtpu;
using namespace albtpu::formats;

constexpr std::uint64_t kMostPoints = 40;     // Read of a file, so that inputs run fast.
constexpr std::size_t kMostExtraBytes = 64;   // Of files whose points are read: each costs some kilobytes.
constexpr std::uint64_t kPiece = 7;           // Points that are read at a time.
constexpr std::size_t kThreadedInEvery = 64;  // Inputs: threads and new decoders take longer than all the rest.

// The decoders of all inputs: their memory is used again.
laz::ChunkDecoder& DecoderFor(const laz::LaszipRecord& record) {
  static std::map<std::string, std::unique_ptr<laz::ChunkDecoder>> decoders;
  constexpr std::size_t kMostDecoders = 100;
  if (decoders.size() == kMostDecoders) decoders.clear();
  laz::LaszipRecord key = record;
  key.chunk_size = 0;
  std::unique_ptr<laz::ChunkDecoder>& decoder = decoders[laz::LaszipRecordData(key)];
  if (decoder == nullptr) decoder = laz::ChunkDecoder::For(record);
  return *decoder;
}

// The first points by the chunk table; fewer, if a chunk cannot be decoded.
std::string RecordsByTable(const laz::ByteSource& file, const laz::LazExtent& extent, const laz::ChunkTable& table) {
  laz::ChunkDecoder& decoder = DecoderFor(extent.record);
  std::string records;
  std::uint64_t left = std::min(extent.point_count, kMostPoints);
  for (const laz::Chunk& chunk : table.chunks) {
    if (left == 0) break;
    if (!decoder.Begin(file, chunk.offset, chunk.offset + chunk.bytes, chunk.points).ok()) return records;
    const std::uint64_t points = std::min(left, chunk.points);
    std::string decoded(points * extent.record.record_length(), '\0');
    if (!decoder.Decode(decoded).ok()) return records;
    if (points == chunk.points && !decoder.End(true).ok()) return records;
    records += decoded;
    left -= points;
  }
  return records;
}

void CheckTable(const laz::ChunkTable& table, const laz::LazExtent& extent, std::uint64_t file_size) {
  std::uint64_t points = 0, next = extent.points_begin + laz::kTableOffsetSize;
  for (const laz::Chunk& chunk : table.chunks) {
    ALBTPU_MUST(chunk.offset >= next && chunk.bytes <= file_size && chunk.points > 0);
    next = chunk.offset + chunk.bytes;
    points += chunk.points;
  }
  ALBTPU_MUST(points == extent.point_count);
  ALBTPU_MUST(next <= table.begin && table.begin < table.end && table.end <= file_size);
}

absl::Status ReadInPieces(const laz::ByteSource& file, const laz::LazExtent& extent, std::string& records) {
  const auto points = laz::LazPoints::Open(file, extent, 1);
  if (!points.ok()) return points.status();
  std::string piece;
  for (std::uint64_t left = std::min(extent.point_count, kMostPoints); left > 0;) {
    const std::uint64_t count = std::min(left, kPiece);
    piece.resize(count * extent.record.record_length());
    if (absl::Status status = (*points)->Read(piece); !status.ok()) return status;
    records += piece;
    left -= count;
  }
  if (extent.point_count <= kMostPoints) {
    ALBTPU_MUST((*points)->end() >= extent.points_begin && (*points)->end() <= extent.points_end);
    ALBTPU_MUST((*points)->tail_end() >= (*points)->end() && (*points)->tail_end() <= file.size());
  }
  return absl::OkStatus();
}

void CheckPoints(const LasReader& reader, bool threaded) {
  const laz::LazExtent& extent = reader.extent();
  const absl::StatusOr<laz::ChunkTable> table =
      laz::ReadChunkTable(reader.bytes(), extent.record, extent.points_begin, extent.point_count);
  if (table.ok()) CheckTable(*table, extent, reader.file_size());
  if (!table.ok() && !absl::IsNotFound(table.status())) fuzz::MustExplain(table.status());
  if (reader.header().extra_bytes() > kMostExtraBytes) return;
  const std::string by_table = table.ok() ? RecordsByTable(reader.bytes(), extent, *table) : "";
  if (!threaded) return;
  std::string records;
  const absl::Status status = ReadInPieces(reader.bytes(), extent, records);
  if (!status.ok()) fuzz::MustExplain(status);
  if (table.ok()) ALBTPU_MUST(by_table.starts_with(records));
  if (status.ok()) {
    ALBTPU_MUST(table.ok() ? by_table == records : absl::IsNotFound(table.status()));
  } else {
    ALBTPU_MUST(!table.ok() || by_table.size() < extent.point_count * extent.record.record_length() ||
                table->end > extent.points_end);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile input;
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  input.Write(file);
  const absl::StatusOr<LasReader> reader = LasReader::Open(input.path());
  if (!reader.ok()) {
    fuzz::MustExplain(reader.status());
  } else if (reader->kind() == LasKind::kLaz) {
    const bool threaded = std::hash<std::string_view>()(file) % kThreadedInEvery == 0;
    CheckPoints(*reader, threaded);
  }
  return 0;
}
