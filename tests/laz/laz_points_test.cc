#include "laz/laz_points.h"

#include <gmock/gmock.h>

#include <atomic>
#include <functional>
#include <new>
#include <string>

#include "laz/coding/little_endian.h"
#include "tests/laz/laz_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::size_t kLength = 20;  // Of point format 0.
constexpr std::uint64_t kBegin = 100;

// `count` points as they lie in a file, from byte kBegin on, in chunks of `size`, with "tail" behind them.
struct File {
  std::string bytes = std::string(kBegin, 'h'), records;
  LazExtent extent;
  std::vector<Chunk> chunks;
  std::uint64_t table = 0, end = 0;

  File(std::uint32_t size, std::size_t count) {
    std::vector<std::size_t> sizes;
    for (std::size_t left = count; left > 0; left -= sizes.back()) sizes.push_back(std::min<std::size_t>(size, left));
    albtpu::testing::LazParts parts = albtpu::testing::TruePoints(0, 0, count, sizes);
    parts.record.chunk_size = size;
    records = parts.records;
    extent = {.record = parts.record, .points_begin = kBegin, .point_count = count};
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
  const File file(37, 1000);
  const MemorySource source(file.bytes);
  for (const int threads : {0, 1, 2, 5}) {
    for (const std::size_t points : {1u, 36u, 1000u}) {
      std::uint64_t end = 0, tail_end = 0;
      const absl::StatusOr<std::string> read = ReadAll(source, file.extent, threads, points, &end, &tail_end);
      EXPECT_EQ(*read, file.records);
      EXPECT_EQ(end, file.end);
      EXPECT_EQ(tail_end, file.bytes.size());
    }
  }
}

TEST(LazPoints, ReadsChunksOfMoreThanABatchAheadInBatches) {
  for (const std::uint32_t size : {420'000u, 130'000u}) {
    const File file(size, 420'000);
    for (const int threads : {1, 2, 5}) {
      const absl::StatusOr<std::string> read = ReadAll(MemorySource(file.bytes), file.extent, threads, 70'001);
      EXPECT_TRUE(*read == file.records);
    }
  }
}

TEST(LazPoints, ReadsTheOneChunkOfTheFirstCompressor) {
  File file(1000, 1000);
  file.extent.record.compressor = Compressor::kPointwise;
  file.extent.record.chunk_size = 0;
  file.extent.points_begin += kTableOffsetSize;
  file.extent.points_end = file.table;
  std::uint64_t end = 0;
  const absl::StatusOr<std::string> read = ReadAll(MemorySource(file.bytes), file.extent, 5, 10, &end);
  EXPECT_EQ(*read, file.records);
  EXPECT_EQ(end, file.table);
  EXPECT_EQ(*LazPoints::First(MemorySource(file.bytes), file.extent), file.records.substr(0, kLength));
}

TEST(LazPoints, GiveTheBytesOfChunksWhereTheyAre) {
  File file(50, 120);
  const MemorySource source(file.bytes);
  const auto read = [&](std::uint64_t first, std::uint64_t count) {
    return *(*LazPoints::Open(source, file.extent))->ReadChunk(first, count);
  };
  for (std::size_t i = 0; i < file.chunks.size(); ++i)
    EXPECT_EQ(read(50 * i, file.chunks[i].points), file.bytes.substr(file.chunks[i].offset, file.chunks[i].bytes));
  for (const auto& [first, count] : {std::pair{0, 49}, {1, 50}, {50, 70}, {100, 50}, {150, 50}, {100, 0}})
    EXPECT_EQ(read(first, count), "") << first << " " << count;
  file.extent.record.compressor = Compressor::kPointwise;
  file.extent.record.chunk_size = 0;
  file.extent.points_begin += kTableOffsetSize;
  file.extent.points_end = file.table;
  EXPECT_EQ(read(0, 120), "");
}

TEST(LazPoints, HaveNoFirstOneWhereTheirRoomIsTooSmall) {
  File file(100, 100);
  file.extent.record.compressor = Compressor::kPointwise;
  file.extent.record.chunk_size = 0;
  file.extent.points_begin += kTableOffsetSize;
  file.extent.points_end = file.extent.points_begin + kLength - 1;
  EXPECT_THAT(std::string(LazPoints::First(MemorySource(file.bytes), file.extent).status().message()),
              HasSubstr("its points have 19 bytes (expected at least 20)"));
}

TEST(LazPoints, MayHaveNoPoints) {
  const File file(50, 0);
  EXPECT_EQ((*LazPoints::Open(MemorySource(file.bytes), file.extent))->end(), file.end);
  LazExtent nothing = file.extent;
  nothing.points_end = nothing.points_begin;
  EXPECT_EQ((*LazPoints::Open(MemorySource(file.bytes), nothing))->end(), kBegin);
}

// Asks `before` about each range of bytes that is read.
class WatchedSource : public MemorySource {
 public:
  using Watch = std::function<absl::Status(std::uint64_t offset, std::size_t size)>;
  WatchedSource(std::string_view bytes, Watch before) : MemorySource(bytes), before_(std::move(before)) {}
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    if (absl::Status status = before_(offset, bytes.size()); !status.ok()) return status;
    return MemorySource::ReadAt(offset, bytes);
  }

 private:
  Watch before_;
};

TEST(LazPoints, ReportsTheFirstFailureOfTheFile) {
  File file(50, 1000);
  for (const std::size_t broken : {0u, 7u, 19u}) {
    const std::uint64_t place = file.chunks[broken].offset + 30;
    const WatchedSource source(file.bytes, [&](std::uint64_t offset, std::size_t size) {
      return offset <= place && place < offset + size ? absl::DataLossError("a broken disk") : absl::OkStatus();
    });
    for (const int threads : {1, 2, 5}) {
      const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, threads);
      std::string read(1000 * kLength, '\0');
      const std::size_t sound = broken * 50 * kLength;
      EXPECT_TRUE((*reader)->Read(std::span(read).first(sound)).ok());
      EXPECT_EQ(read.substr(0, sound), file.records.substr(0, sound));
      const std::string expected = "chunk " + std::to_string(broken + 1) + " of 20: a broken disk";
      for (int i = 0; i < 2; ++i)  // Reading does not go on.
        EXPECT_THAT(std::string((*reader)->Read(std::span(read).subspan(sound)).message()), HasSubstr(expected));
    }
  }
}

TEST(LazPoints, ReportsTheFirstOfSeveralFailures) {
  File file(50, 1000);
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
  const File file(50, 5000);
  for (const int threads : {1, 2, 5}) {
    for (int i = 0; i < 20; ++i) {
      const MemorySource source(file.bytes);
      const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, threads);
      std::string read(static_cast<std::size_t>(i) * kLength, '\0');
      EXPECT_TRUE((*reader)->Read(std::span(read)).ok());
    }
  }
}

TEST(LazPoints, DecodesNoFurtherAheadThanTwoBatchesAThread) {
  const File file(50, 5000);
  std::atomic<std::uint64_t> read_bytes = 0;
  const WatchedSource source(file.bytes, [&](std::uint64_t, std::size_t size) {
    read_bytes += size;
    return absl::OkStatus();
  });
  std::uint64_t most = file.bytes.size() - file.table + 2 * kTableOffsetSize + 16;  // The table.
  for (std::size_t i = 0; i < 1 + 2 * 2 + 2; ++i) most += file.chunks[i].bytes;     // And two chunks were begun.
  {
    const absl::StatusOr<std::unique_ptr<LazPoints>> reader = LazPoints::Open(source, file.extent, 2);
    std::string read(kLength, '\0');
    EXPECT_TRUE((*reader)->Read(std::span(read)).ok());
  }
  EXPECT_LE(read_bytes, most);
}

TEST(LazPoints, RefusesPointsWithoutRoom) {
  File file(50, 100);
  file.extent.points_end = kBegin + 7;
  EXPECT_THAT(std::string(LazPoints::Open(MemorySource(file.bytes), file.extent).status().message()),
              HasSubstr("its points have 7 bytes"));
}

TEST(LazPoints, RefusesPointsThatNothingCounts) {
  File file(64, 1000);
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

TEST(LazPoints, ReportsMemoryThatIsTooSmall) {
  const File file(50, 1000);
  const WatchedSource source(file.bytes, [&](std::uint64_t offset, std::size_t) {
    if (offset == file.chunks[7].offset) throw std::bad_alloc();
    return absl::OkStatus();
  });
  for (const int threads : {1, 2, 5}) {
    const absl::Status status = ReadAll(source, file.extent, threads, 1000).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
    EXPECT_THAT(std::string(status.message()), StartsWith("chunk 8 of 20: the memory is too small"));
  }
}

// The header, and so a file without table, may state any number of points.
TEST(LazPoints, StopsWhereTheBytesEnd) {
  File file(kCommonChunkSize, 1000);
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
