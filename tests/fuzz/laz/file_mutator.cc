// Mutates LAZ files part by part: single fields of the header, the LASzip record and the chunk table lie, and the bytes
// of chunks change while the rest stays true. Some inputs are mutated byte by byte.
#include <algorithm>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "formats/laz/chunk_table.h"
#include "formats/laz/coding/arithmetic_decoder.h"
#include "formats/laz/items/laszip_record.h"
#include "tests/fuzz/mutation.h"

namespace {

using namespace albtpu;

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
  Editor(std::string file, std::minstd_rand& random) : file_(std::move(file)), random_(random) {}

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
    std::string bytes = file_.substr(begin, end - begin);
    // Of the same size, so that the table stays true.
    if (LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size(), bytes.size()) > 0)
      file_.replace(begin, bytes.size(), bytes);
  }

  std::string file_;
  std::minstd_rand& random_;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::string file = Editor(std::string(reinterpret_cast<const char*>(data), size), random).Edited();
  return albtpu::fuzz::Replace(file, data, size, max_size);
}
