// Arbitrary bytes as a LAZ file are rejected with a reason; or their points, decoded by the chunk table, are those that
// are read front to back, and nothing beyond the file is asked for.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "formats/las/las_reader.h"
#include "laz/chunk_table.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/laszip_record.h"
#include "laz/laz_points.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::formats;

constexpr std::uint64_t kMostPoints = 40;    // Read of a file, so that inputs run fast.
constexpr std::size_t kMostExtraBytes = 64;  // Of files whose points are read: each costs some kilobytes.
constexpr std::uint64_t kPiece = 7;          // Points that are read at a time.

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
  if (!table.ok() && !absl::IsNotFound(table.status())) MustExplain(table.status());
  if (reader.header().extra_bytes() > kMostExtraBytes) return;
  const std::string by_table = table.ok() ? RecordsByTable(reader.bytes(), extent, *table) : "";
  if (!threaded) return;
  std::string records;
  const absl::Status status = ReadInPieces(reader.bytes(), extent, records);
  if (!status.ok()) MustExplain(status);
  if (table.ok()) ALBTPU_MUST(by_table.starts_with(records));
  if (status.ok()) {
    ALBTPU_MUST(table.ok() ? by_table == records : absl::IsNotFound(table.status()));
  } else {
    ALBTPU_MUST(!table.ok() || by_table.size() < extent.point_count * extent.record.record_length() ||
                table->end > extent.points_end);
  }
}

void LazFileTarget(std::string_view file) {
  static MemoryFile input;
  input.Write(file);
  const absl::StatusOr<LasReader> reader = LasReader::Open(input.path());
  if (!reader.ok()) return MustExplain(reader.status());
  // Threads and new decoders take longer than all the rest.
  if (reader->kind() == LasKind::kLaz) CheckPoints(*reader, IsOneIn(64, file));
}

// Changes a file part by part: single fields of the header, the LASzip record and the chunk table lie, and the bytes of
// chunks change while the rest stays true.

struct Field {
  std::size_t offset, size;
};

// Of the header (LAS Specification 1.4 R15, table 3): version, sizes, counts, formats and offsets.
constexpr Field kHeaderFields[] = {{6, 2},   {24, 1},  {25, 1},  {94, 2},  {96, 4},  {100, 4}, {104, 1}, {104, 1},
                                   {105, 2}, {107, 4}, {107, 4}, {227, 8}, {235, 8}, {243, 4}, {247, 8}, {247, 8}};
// Of the LASzip record: compressor, coder, version, options, chunk size, special EVLRs, items; then of the first items.
constexpr Field kRecordFields[] = {{0, 2},  {0, 2},  {2, 2},  {4, 1},  {8, 4},  {12, 4}, {12, 4}, {12, 4},
                                   {16, 8}, {24, 8}, {32, 2}, {34, 2}, {36, 2}, {38, 2}, {40, 2}, {42, 2},
                                   {44, 2}, {46, 2}, {48, 2}, {50, 2}, {52, 2}, {54, 2}, {56, 2}};
constexpr std::size_t kVlrHeader = 54;

class Editor {
 public:
  Editor(std::string file, Random& random) : file_(std::move(file)), random_(random) {}

  std::string Edited() {
    for (std::size_t i = 0, changes = 1 + random_() % 2; i < changes; ++i) Change();
    return std::move(file_);
  }

 private:
  void Change() {
    switch (random_() % 8) {
      case 0:
        return Lie(kHeaderFields[random_() % std::size(kHeaderFields)]);
      case 1: {
        const Field field = kRecordFields[random_() % std::size(kRecordFields)];
        const std::size_t begin = RecordBegin();
        if (begin > 0) Lie({begin + field.offset, field.size});
        return;
      }
      case 2:
        return ChangeTableOffset();
      case 3:
      case 4:
        return ChangeTable();
      case 5:
        return ChangePointCount();
      default:
        return ChangeChunkBytes();
    }
  }

  template <typename Number>
  std::optional<Number> Get(std::size_t offset) const {
    if (offset > file_.size() || file_.size() - offset < sizeof(Number)) return std::nullopt;
    Number number;
    std::memcpy(&number, file_.data() + offset, sizeof number);
    return number;
  }

  void Put(std::uint64_t number, const Field& field) {
    if (field.offset <= file_.size() && file_.size() - field.offset >= field.size)
      std::memcpy(file_.data() + field.offset, &number, field.size);
  }

  std::uint64_t AnyNumber(std::uint64_t truth) {
    switch (random_() % 4) {
      case 0:
        return truth + random_() % 9 - 4;
      case 1:
        return random_() % 16;
      case 2:
        return random_() % (file_.size() + 16);
      default:
        return (std::uint64_t{1} << random_() % 64) + random_() % 3 - 2;
    }
  }

  void Lie(const Field& field) { Put(AnyNumber(Get<std::uint64_t>(field.offset).value_or(0)), field); }

  std::uint64_t PointsBegin() const { return Get<std::uint32_t>(96).value_or(0); }

  // 0: none.
  std::size_t RecordBegin() const {
    const std::size_t user = file_.find(laz::kLaszipUser);
    return user == std::string::npos || user < 2 ? 0 : user - 2 + kVlrHeader;
  }

  void ChangeTableOffset() {
    const std::uint64_t begin = PointsBegin();
    const std::optional<std::uint64_t> offset = Get<std::uint64_t>(begin);
    if (!offset.has_value()) return;
    switch (random_() % 4) {
      case 0:  // Where files that were written to a pipe have it.
        file_.append(reinterpret_cast<const char*>(&*offset), sizeof *offset);
        [[fallthrough]];
      case 1:
        return Put(~std::uint64_t{0}, {begin, sizeof *offset});
      case 2:  // No table at all.
        Put(~std::uint64_t{0}, {begin, sizeof *offset});
        file_.resize(std::min<std::uint64_t>(file_.size(), *offset));
        return;
      default:
        Lie({begin, sizeof *offset});
    }
  }

  std::optional<laz::LaszipRecord> Record() const {
    const std::size_t begin = RecordBegin();
    const auto format = Get<std::uint8_t>(104);
    const auto length = Get<std::uint16_t>(105), size = Get<std::uint16_t>(begin - kVlrHeader + 20);
    if (begin == 0 || begin > file_.size() || !format.has_value() || !length.has_value() || !size.has_value())
      return std::nullopt;
    const int point_format = *format & ~laz::kCompressedFlag;
    if (point_format > 10) return std::nullopt;
    const absl::StatusOr<laz::LaszipRecord> record =
        laz::ParseLaszipRecord(std::string_view(file_).substr(begin, *size), point_format, *length);
    return record.ok() ? std::optional(*record) : std::nullopt;
  }

  std::uint64_t PointCount() const {
    const auto legacy = Get<std::uint32_t>(107);
    return legacy.value_or(0) != 0 ? *legacy : Get<std::uint64_t>(247).value_or(0);
  }

  std::optional<laz::ChunkTable> Table(const laz::LaszipRecord& record) const {
    if (PointsBegin() > file_.size()) return std::nullopt;
    const laz::MemorySource source(file_);
    const absl::StatusOr<laz::ChunkTable> table = laz::ReadChunkTable(source, record, PointsBegin(), PointCount());
    return table.ok() ? std::optional(*table) : std::nullopt;
  }

  void ChangeTable() {
    const std::optional<laz::LaszipRecord> record = Record();
    if (!record.has_value()) return;
    const std::optional<laz::ChunkTable> table = Table(*record);
    if (!table.has_value()) return;
    std::vector<laz::Chunk> chunks = table->chunks;
    if (chunks.empty() || random_() % 8 == 0) {
      chunks.push_back({.bytes = random_() % 64, .points = random_() % 4});
    } else {
      laz::Chunk& chunk = chunks[random_() % chunks.size()];
      laz::Chunk& other = chunks[random_() % chunks.size()];
      switch (random_() % 4) {
        case 0:
          chunk.bytes = AnyNumber(chunk.bytes) & 0xFFFFFFFF;
          break;
        case 1:
          chunk.points = AnyNumber(chunk.points) & 0xFFFFFFFF;
          break;
        case 2:
          ++chunk.bytes;
          --other.bytes;
          break;
        default:
          ++chunk.points;
          --other.points;
      }
    }
    file_.replace(table->begin, table->end - table->begin, laz::ChunkTableBytes(*record, chunks));
  }

  void ChangePointCount() {
    const std::uint64_t count = AnyNumber(PointCount());
    Put(count, {247, 8});
    if (Get<std::uint8_t>(104).value_or(0) % 64 < 6) Put(count, {107, 4});
  }

  void ChangeChunkBytes() {
    const std::uint64_t begin = PointsBegin() + laz::kTableOffsetSize;
    const std::uint64_t end = std::min<std::uint64_t>(Get<std::uint64_t>(PointsBegin()).value_or(0), file_.size());
    if (begin >= end) return;
    const std::string bytes = MutateBytes(file_.substr(begin, end - begin), end - begin);
    file_.replace(begin, bytes.size(), bytes);  // Of the same size, so that the table stays true.
  }

  std::string file_;
  Random& random_;
};

std::string MutateLazFile(std::string_view input, std::size_t, Random& random) {
  return random() % 4 == 0 ? "" : Editor(std::string(input), random).Edited();
}

}  // namespace

const std::vector<Target> kTargets = {{"laz_file", LazFileTarget, MutateLazFile}};

}  // namespace albtpu::fuzz
