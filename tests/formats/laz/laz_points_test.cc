#include "formats/laz/laz_points.h"

#include <gmock/gmock.h>

#include <atomic>
#include <new>
#include <random>
#include <string>

#include "formats/laz/coding/little_endian.h"
#include "tests/formats/laz/laz_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::size_t kLength = 20;  // Of point format 0.
constexpr std::uint64_t kBegin = 100;

std::string Records(std::size_t count) {
  std::mt19937 random(1);
  std::string records(count * kLength, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    char* const record = &records[i * kLength];
    Store(static_cast<std::int32_t>(i * 10 + random() % 7), record);
    Store(static_cast<std::int32_t>(random() % 1000), record + 4);
    Store(static_cast<std::int32_t>(random() % 100), record + 8);
    record[14] = 0x09;
    record[15] = static_cast<char>(random() % 3);
  }
  return records;
}

// Points as they lie in a file, from byte kBegin on, with "tail" behind them.
struct File {
  std::string bytes = std::string(kBegin, 'h');
  LazExtent extent;
  std::vector<Chunk> chunks;
  std::uint64_t table = 0, end = 0;

  File(const std::string& records, const std::vector<std::size_t>& sizes, std::uint32_t chunk_size) {
    albtpu::testing::LazParts parts = albtpu::testing::CompressPoints(0, kLength, records, sizes);
    parts.record.chunk_size = chunk_size;
    extent = {.record = parts.record, .points_begin = kBegin, .point_count = parts.point_count()};
    bytes += PointsSection(parts, kBegin);
    table = Load<std::uint64_t>(bytes, kBegin);
    end = extent.points_end = bytes.size();
    bytes += "tail";
    chunks = parts.table;
    std::uint64_t offset = kBegin + kTableOffsetSize;
    for (Chunk& chunk : chunks) {
      chunk.offset = offset;
      offset += chunk.bytes;
    }
  }
};

File InChunksOf(std::uint32_t size, const std::string& records) {
  std::vector<std::size_t> sizes;
  for (std::size_t left = records.size() / kLength; left > 0; left -= sizes.back())
    sizes.push_back(std::min<std::size_t>(size, left));
  return File(records, sizes, size);
}

// Reads to the end in pieces of `points`.
absl::StatusOr<std::string> ReadAll(const ByteSource& source, const LazExtent& extent, int threads, std::size_t points,
                                    std::uint64_t* end = nullptr, std::uint64_t* tail_end = nullptr) {
  const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, extent, threads);
  if (!reader.ok()) return reader.status();
  std::string records(extent.point_count * kLength, '\0');
  for (std::size_t at = 0; at < records.size();) {
    const std::size_t size = std::min(points * kLength, records.size() - at);
    if (absl::Status status = (*reader)->Read(std::span(records).subspan(at, size)); !status.ok()) return status;
    at += size;
  }
  if (end != nullptr) *end = (*reader)->end();
  if (tail_end != nullptr) *tail_end = (*reader)->tail_end();
  return records;
}

TEST(LazPoints, GivesThePointsInTheOrderOfTheFile) {
  const std::string records = Records(1000);
  const File file = InChunksOf(37, records);
  const MemorySource source(file.bytes);
  for (const int threads : {0, 1, 2, 5}) {
    for (const std::size_t points : {1u, 36u, 1000u}) {
      std::uint64_t end = 0, tail_end = 0;
      const absl::StatusOr<std::string> read = ReadAll(source, file.extent, threads, points, &end, &tail_end);
      EXPECT_EQ(*read, records);
      EXPECT_EQ(end, file.end);
      EXPECT_EQ(tail_end, file.bytes.size());
    }
  }
}

TEST(LazPoints, ReadsChunksOfMoreThanABatchAheadInBatches) {
  const std::string records = Records(420'000);
  for (const std::uint32_t size : {420'000u, 130'000u}) {
    const File file = InChunksOf(size, records);
    for (const int threads : {1, 2, 5}) {
      const absl::StatusOr<std::string> read = ReadAll(MemorySource(file.bytes), file.extent, threads, 70'001);
      EXPECT_TRUE(*read == records);
    }
  }
}

TEST(LazPoints, ReadsTheOneChunkOfTheFirstCompressor) {
  const std::string records = Records(1000);
  File file = InChunksOf(1000, records);
  file.extent.record.compressor = Compressor::kPointwise;
  file.extent.record.chunk_size = 0;
  file.extent.points_begin += kTableOffsetSize;
  file.extent.points_end = file.table;
  std::uint64_t end = 0;
  const absl::StatusOr<std::string> read = ReadAll(MemorySource(file.bytes), file.extent, 5, 10, &end);
  EXPECT_EQ(*read, records);
  EXPECT_EQ(end, file.table);
}

TEST(LazPoints, MayHaveNoPoints) {
  const File file = InChunksOf(50, "");
  EXPECT_EQ((*LazPoints::Open(MemorySource(file.bytes), file.extent))->end(), file.end);
  LazExtent nothing = file.extent;
  nothing.points_end = nothing.points_begin;
  EXPECT_EQ((*LazPoints::Open(MemorySource(file.bytes), nothing))->end(), kBegin);
}

// Fails to read one byte.
class BrokenSource : public MemorySource {
 public:
  BrokenSource(std::string_view bytes, std::uint64_t broken) : MemorySource(bytes), broken_(broken) {}
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    if (offset <= broken_ && broken_ < offset + bytes.size()) return absl::DataLossError("a broken disk");
    return MemorySource::ReadAt(offset, bytes);
  }

 private:
  std::uint64_t broken_;
};

TEST(LazPoints, ReportsTheFirstFailureOfTheFile) {
  const std::string records = Records(1000);
  File file = InChunksOf(50, records);
  for (const std::size_t broken : {0u, 7u, 19u}) {
    const BrokenSource source(file.bytes, file.chunks[broken].offset + 30);
    for (const int threads : {1, 2, 5}) {
      const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, threads);
      std::string read(1000 * kLength, '\0');
      const std::size_t sound = broken * 50 * kLength;
      EXPECT_TRUE((*reader)->Read(std::span(read).first(sound)).ok());
      EXPECT_EQ(read.substr(0, sound), records.substr(0, sound));
      const std::string expected = "chunk " + std::to_string(broken + 1) + " of 20: a broken disk";
      for (int i = 0; i < 2; ++i)  // Reading does not go on.
        EXPECT_THAT(std::string((*reader)->Read(std::span(read).subspan(sound)).message()), HasSubstr(expected));
    }
  }
}

TEST(LazPoints, ReportsTheFirstOfSeveralFailures) {
  File file = InChunksOf(50, Records(1000));
  // Chunk 6 has bytes that chunk 7 lacks.
  const std::uint64_t moved = file.chunks[6].bytes / 2;
  std::string bytes = file.bytes.substr(0, file.table);
  file.chunks[5].bytes += moved;
  file.chunks[6].bytes -= moved;
  bytes += ChunkTableBytes(file.extent.record, file.chunks);
  file.extent.points_end = bytes.size();
  for (const int threads : {1, 2, 5}) {
    const auto read = ReadAll(MemorySource(bytes), file.extent, threads, 1000);
    EXPECT_THAT(std::string(read.status().message()), HasSubstr("chunk 6 of 20: "));
    EXPECT_THAT(std::string(read.status().message()), HasSubstr("; get another copy of the file"));
  }
}

TEST(LazPoints, MayBeLeftEarly) {
  const File file = InChunksOf(50, Records(5000));
  for (const int threads : {1, 2, 5}) {
    for (int i = 0; i < 20; ++i) {
      const MemorySource source(file.bytes);
      const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, threads);
      std::string read(static_cast<std::size_t>(i) * kLength, '\0');
      EXPECT_TRUE((*reader)->Read(std::span(read)).ok());
    }
  }
}

// Counts the bytes that are read.
class CountingSource : public MemorySource {
 public:
  using MemorySource::MemorySource;
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    read += bytes.size();
    return MemorySource::ReadAt(offset, bytes);
  }
  mutable std::atomic<std::uint64_t> read = 0;
};

TEST(LazPoints, DecodesNoFurtherAheadThanTwoBatchesAThread) {
  const File file = InChunksOf(50, Records(5000));
  const CountingSource source(file.bytes);
  std::uint64_t most = file.bytes.size() - file.table + 2 * kTableOffsetSize + 16;  // The table.
  for (std::size_t i = 0; i < 1 + 2 * 2 + 2; ++i) most += file.chunks[i].bytes;     // And two chunks were begun.
  {
    const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, 2);
    std::string read(kLength, '\0');
    EXPECT_TRUE((*reader)->Read(std::span(read)).ok());
  }
  EXPECT_LE(source.read, most);
}

TEST(LazPoints, RefusesPointsWithoutRoom) {
  File file = InChunksOf(50, Records(100));
  file.extent.points_end = kBegin + 7;
  EXPECT_THAT(std::string(LazPoints::Open(MemorySource(file.bytes), file.extent).status().message()),
              HasSubstr("its points have 7 bytes"));
}

TEST(LazPoints, RefusesPointsThatNothingCounts) {
  File file = InChunksOf(64, Records(1000));
  file.bytes.resize(file.table);  // The writer was interrupted.
  Store(kBegin, &file.bytes[kBegin]);
  file.extent.points_end = file.bytes.size();
  const MemorySource source(file.bytes);
  for (const std::uint64_t count : {0u, 500u, 512u, 960u}) {
    file.extent.point_count = count;
    const absl::Status status = ReadAll(source, file.extent, 1, 100).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << count;
    EXPECT_THAT(std::string(status.message()),
                StartsWith("its header states " + std::to_string(count) + " points, but "));
  }
}

// Has no memory for a chunk that begins there.
class GreedySource : public MemorySource {
 public:
  GreedySource(std::string_view bytes, std::uint64_t chunk) : MemorySource(bytes), chunk_(chunk) {}
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    if (offset == chunk_) throw std::bad_alloc();
    return MemorySource::ReadAt(offset, bytes);
  }

 private:
  std::uint64_t chunk_;
};

TEST(LazPoints, ReportsMemoryThatIsTooSmall) {
  const File file = InChunksOf(50, Records(1000));
  const GreedySource source(file.bytes, file.chunks[7].offset);
  for (const int threads : {1, 2, 5}) {
    const absl::Status status = ReadAll(source, file.extent, threads, 1000).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
    EXPECT_THAT(std::string(status.message()), StartsWith("chunk 8 of 20: the memory is too small"));
  }
}

// The header, and so a file without table, may state any number of points.
TEST(LazPoints, StopsWhereTheBytesEnd) {
  File file = InChunksOf(kCommonChunkSize, Records(1000));
  file.bytes.resize(file.table);
  Store<std::int64_t>(-1, &file.bytes[kBegin]);
  file.extent.points_end = file.bytes.size();
  file.extent.record.chunk_size = kVariableChunks - 1;
  file.extent.point_count = std::uint64_t{1} << 60;
  const MemorySource source(file.bytes);
  const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent);
  std::string read(200'000 * kLength, '\0');
  EXPECT_THAT(std::string((*reader)->Read(std::span(read)).message()), HasSubstr("chunk 1: "));
}

}  // namespace
}  // namespace albtpu::laz
