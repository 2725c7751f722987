// The layout of the table, in bytes:
//
//   0  u32  version, 0
//   4  u32  number of chunks
//   8  for each chunk the number of its points, where chunks are of variable length, and the number of its bytes:
//      integers in an arithmetic code, each predicted by that of the chunk before.
#include "laz/chunk_table.h"

#include <algorithm>
#include <array>
#include <memory>

#include "laz/coding/arithmetic_encoder.h"
#include "laz/coding/integer_coder.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::laz {
namespace {

constexpr std::uint64_t kHeadSize = 8;

// Points and bytes of a chunk, as the table codes them.
struct Sizes {
  std::uint32_t points = 0, bytes = 0;
};

template <typename Coder>
class SizesCoder {
 public:
  explicit SizesCoder(bool variable) : variable_(variable) {}

  // Decodes the next sizes, or encodes `sizes`; returns them. Leaves the points of chunks of constant length alone.
  Sizes Code(Coder& coder, Sizes sizes) {
    if (variable_) sizes.points = Code(coder, last_.points, sizes.points, 0);
    sizes.bytes = Code(coder, last_.bytes, sizes.bytes, 1);
    return last_ = sizes;
  }

 private:
  std::uint32_t Code(Coder& coder, std::uint32_t predicted, std::uint32_t actual, std::uint32_t context) {
    return static_cast<std::uint32_t>(
        integers_->Code(coder, static_cast<std::int32_t>(predicted), static_cast<std::int32_t>(actual), context));
  }

  using Integers = IntegerCoder<Coder, 32, 2>;
  bool variable_;
  Sizes last_;
  std::unique_ptr<Integers> integers_ = std::make_unique<Integers>();
};

template <typename Number>
absl::StatusOr<Number> ReadNumber(const ByteSource& file, std::uint64_t offset) {
  std::array<char, sizeof(Number)> bytes;
  RETURN_IF_ERROR(file.ReadAt(offset, bytes));
  return Load<Number>({bytes.data(), bytes.size()}, 0);
}

template <typename... Pieces>
absl::Status Broken(const Pieces&... problem) {
  return Damaged("its chunk table ", problem...);
}

// Finds the table without reading it. NotFound: there is none.
absl::StatusOr<ChunkTable> FindTable(const ByteSource& file, std::uint64_t points_begin) {
  const std::uint64_t first = points_begin + kTableOffsetSize, size = file.size();
  ASSIGN_OR_RETURN(const std::uint64_t stated, ReadNumber<std::uint64_t>(file, points_begin));
  if (stated == points_begin) return absl::NotFoundError("the writer did not reach the chunk table");
  if (stated != 0 && stated != ~std::uint64_t{0}) {
    if (stated >= first && stated <= size && size - stated >= kHeadSize)
      return ChunkTable{.chunks = {}, .begin = stated};
    return Broken("begins at byte ", stated, " (expected ", first, " or more, and ", kHeadSize,
                  " bytes or more before the end of the file at byte ", size, ")");
  }
  ASSIGN_OR_RETURN(const std::uint64_t last, ReadNumber<std::uint64_t>(file, size - sizeof(std::uint64_t)));
  if (last >= first && last <= size && size - last >= kHeadSize + sizeof last) {
    ASSIGN_OR_RETURN(const std::uint32_t version, ReadNumber<std::uint32_t>(file, last));
    if (version == 0) return ChunkTable{.chunks = {}, .begin = last, .offset_at_end = true};
  }
  return absl::NotFoundError("the file was written to a pipe, without the offset of its chunk table");
}

// Requires that no more points and bytes are stated than are left.
absl::StatusOr<std::vector<Chunk>> ReadChunks(ArithmeticDecoder& decoder, const LaszipRecord& record,
                                              std::uint32_t count, std::uint64_t begin, std::uint64_t end,
                                              std::uint64_t point_count) {
  const bool variable = record.chunk_size == kVariableChunks;
  SizesCoder<ArithmeticDecoder> sizes_coder(variable);
  std::vector<Chunk> chunks;
  std::uint64_t offset = begin, points_left = point_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sizes sizes = sizes_coder.Code(decoder, {});
    if (!decoder.status().ok()) return decoder.status();
    if (decoder.missing() > 0) return Broken("ends before its chunk ", i + 1, " of ", count);
    const std::uint64_t points = variable ? sizes.points : std::min<std::uint64_t>(record.chunk_size, points_left);
    if (points > points_left)
      return Broken("states more points than the header (", point_count, ") up to chunk ", i + 1, " of ", count);
    if (sizes.bytes > end - offset)
      return Broken("states more bytes than lie before it (", end - begin, ") up to chunk ", i + 1, " of ", count);
    // Each chunk begins with an uncompressed record. Some writers end with a chunk without points.
    if ((sizes.bytes < record.record_length()) != (points == 0)) {
      return Broken("states ", sizes.bytes, " bytes for chunk ", i + 1, " of ", count, " (expected ",
                    points == 0 ? "fewer than " : "at least ", record.record_length(), " for its ", points, " points)");
    }
    if (points > 0) chunks.push_back({offset, sizes.bytes, points});
    offset += sizes.bytes;
    points_left -= points;
  }
  if (points_left > 0) {
    return Broken("states ", point_count - points_left, " points in ", count, " chunks (expected ", point_count,
                  ", as the header states)");
  }
  return chunks;
}

}  // namespace

absl::StatusOr<ChunkTable> ReadChunkTable(const ByteSource& file, const LaszipRecord& record,
                                          std::uint64_t points_begin, std::uint64_t point_count) {
  if (record.compressor == Compressor::kPointwise) return absl::NotFoundError("compressor 1 has no chunk table");
  const std::uint64_t size = file.size(), first = points_begin + kTableOffsetSize;
  if (points_begin > size || size - points_begin < kTableOffsetSize) {
    return Damaged("its points begin at byte ", points_begin, ", less than ", kTableOffsetSize,
                   " bytes before the end of the file at byte ", size);
  }
  ASSIGN_OR_RETURN(ChunkTable table, FindTable(file, points_begin));
  ASSIGN_OR_RETURN(const std::uint32_t version, ReadNumber<std::uint32_t>(file, table.begin));
  if (version != 0) return Broken("states version ", version, " (expected 0)");
  ASSIGN_OR_RETURN(const std::uint32_t count, ReadNumber<std::uint32_t>(file, table.begin + 4));
  // Each chunk with points begins with an uncompressed record, so the size of the file bounds the memory, too. Some
  // writers end with chunks without points.
  constexpr std::uint64_t kMostEmpty = 1000;
  const std::uint64_t most = (table.begin - first) / record.record_length() + kMostEmpty;
  if (count > most)
    return Broken("states ", count, " chunks (expected at most ", most, " in ", table.begin - first, " bytes)");
  if (count == 0) {
    if (point_count > 0) return Broken("states no chunks for ", point_count, " points");
    table.end = table.begin + kHeadSize;
    return table;
  }
  ByteWindow window;
  ArithmeticDecoder decoder;
  decoder.Begin(window, file, table.begin + kHeadSize, size);
  ASSIGN_OR_RETURN(table.chunks, ReadChunks(decoder, record, count, first, table.begin, point_count));
  table.end = decoder.position();
  return table;
}

std::string ChunkTableBytes(const LaszipRecord& record, const std::vector<Chunk>& chunks) {
  std::string bytes(kHeadSize, '\0');
  Store(static_cast<std::uint32_t>(chunks.size()), bytes.data() + 4);
  if (chunks.empty()) return bytes;
  ArithmeticEncoder encoder;
  encoder.Begin();
  SizesCoder<ArithmeticEncoder> sizes_coder(record.chunk_size == kVariableChunks);
  for (const Chunk& chunk : chunks)
    sizes_coder.Code(encoder, {static_cast<std::uint32_t>(chunk.points), static_cast<std::uint32_t>(chunk.bytes)});
  return bytes + encoder.Finish();
}

}  // namespace albtpu::laz
