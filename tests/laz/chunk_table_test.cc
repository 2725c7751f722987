#include "laz/chunk_table.h"

#include <gmock/gmock.h>

#include <random>

#include "laz/coding/little_endian.h"

namespace albtpu::laz {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint64_t kPointsBegin = 100;
constexpr std::size_t kRecordLength = 28;

LaszipRecord RecordWith(std::uint32_t chunk_size) { return RecordFor(1, kRecordLength, chunk_size); }

// A file with `chunks`, which get their offsets, and their table.
struct TableFile {
  explicit TableFile(const LaszipRecord& laszip_record, std::vector<Chunk> all) : record(laszip_record), chunks(all) {
    bytes.assign(kPointsBegin + kTableOffsetSize, 'p');
    for (Chunk& chunk : chunks) {
      chunk.offset = bytes.size();
      bytes.append(chunk.bytes, 'c');
      point_count += chunk.points;
    }
    begin = bytes.size();
    bytes += ChunkTableBytes(record, chunks);
    end = bytes.size();
    StateOffset(begin);
  }

  void StateOffset(std::uint64_t offset) { Store(offset, bytes.data() + kPointsBegin); }
  absl::StatusOr<ChunkTable> Read() const {
    return ReadChunkTable(MemorySource(bytes), record, kPointsBegin, point_count);
  }

  LaszipRecord record;
  std::vector<Chunk> chunks;
  std::string bytes;
  std::uint64_t begin = 0, end = 0, point_count = 0;
};

std::vector<Chunk> RandomChunks(std::size_t count) {
  std::mt19937 random(1);
  std::vector<Chunk> chunks(count);
  for (Chunk& chunk : chunks) {
    chunk.points = 1 + random() % 3 * (random() % 100000);
    chunk.bytes = kRecordLength + 4 + random() % 5000;
  }
  return chunks;
}

TableFile ThreeChunks() { return TableFile(RecordWith(10), {{0, 300, 10}, {0, 40, 10}, {0, 32, 1}}); }

void ExpectTable(const absl::StatusOr<ChunkTable>& table, const TableFile& file) {
  EXPECT_EQ(table->chunks, file.chunks);
  EXPECT_EQ(table->begin, file.begin);
  EXPECT_EQ(table->end, file.end);
}

void ExpectRefusal(const absl::StatusOr<ChunkTable>& table, const std::string& problem) {
  EXPECT_EQ(table.status().code(), absl::StatusCode::kDataLoss) << table.status();
  EXPECT_THAT(std::string(table.status().message()),
              AllOf(StartsWith("its "), HasSubstr(problem), EndsWith("; get another copy of the file")));
}

TEST(ChunkTable, HasTheChunksThatWereWritten) {
  for (const std::size_t count : {1, 2, 1000}) {
    const TableFile file(RecordWith(kVariableChunks), RandomChunks(count));
    ExpectTable(file.Read(), file);
  }
  const TableFile file = ThreeChunks();
  ExpectTable(file.Read(), file);
}

TEST(ChunkTable, OfNoPointsHasNoChunks) {
  const TableFile file(RecordWith(50000), {});
  EXPECT_EQ(file.end - file.begin, 8u);
  ExpectTable(file.Read(), file);
}

TEST(ChunkTable, OfAPipeIsFoundByTheLastBytesOfTheFile) {
  for (const std::uint64_t stated : {std::uint64_t{0}, ~std::uint64_t{0}}) {
    TableFile file = ThreeChunks();
    file.StateOffset(stated);
    EXPECT_TRUE(absl::IsNotFound(file.Read().status())) << file.Read().status();
    file.bytes.append(8, '\0');
    EXPECT_TRUE(absl::IsNotFound(file.Read().status())) << file.Read().status();
    Store(file.begin, file.bytes.data() + file.end);
    ExpectTable(file.Read(), file);
    EXPECT_TRUE(file.Read()->offset_at_end);
  }
}

TEST(ChunkTable, IsAbsentWhereTheWriterDidNotReachIt) {
  TableFile file = ThreeChunks();
  file.StateOffset(kPointsBegin);
  EXPECT_TRUE(absl::IsNotFound(file.Read().status())) << file.Read().status();
}

TEST(ChunkTable, IsAbsentForTheOldestCompressor) {
  TableFile file = ThreeChunks();
  file.record.compressor = Compressor::kPointwise;
  EXPECT_TRUE(absl::IsNotFound(file.Read().status())) << file.Read().status();
}

TEST(ChunkTable, IsRefusedWhereItsOffsetIsNotBehindThePoints) {
  TableFile file = ThreeChunks();
  for (const std::uint64_t offset :
       {std::uint64_t{1}, kPointsBegin + 7, file.end - 7, file.end, ~std::uint64_t{0} - 1}) {
    file.StateOffset(offset);
    ExpectRefusal(file.Read(), "begins at byte " + std::to_string(offset));
  }
  file.bytes.resize(kPointsBegin + 7);
  ExpectRefusal(file.Read(), "less than 8 bytes before the end");
}

TEST(ChunkTable, IsRefusedInAnotherVersion) {
  TableFile file = ThreeChunks();
  file.bytes[file.begin] = 1;
  ExpectRefusal(file.Read(), "version 1 (expected 0)");
}

// As some writers end their files, of few points, too.
TEST(ChunkTable, MayEndWithChunksWithoutPoints) {
  for (const std::size_t chunks : {1, 2}) {
    std::vector<Chunk> all(chunks, Chunk{0, kRecordLength, 1});
    all.resize(chunks + 2, Chunk{0, 4, 0});
    TableFile file(RecordWith(kVariableChunks), all);
    file.chunks.resize(chunks);
    ExpectTable(file.Read(), file);
  }
}

TEST(ChunkTable, IsRefusedWithMoreChunksThanFitBeforeIt) {
  TableFile file = ThreeChunks();
  Store(std::uint32_t{0xFFFFFFFF}, file.bytes.data() + file.begin + 4);
  ExpectRefusal(file.Read(), "states 4294967295 chunks (expected at most 1013 in 372 bytes)");
}

TEST(ChunkTable, IsRefusedWhereChunksExceedTheBytesBeforeIt) {
  TableFile file = ThreeChunks();
  const std::string table = ChunkTableBytes(file.record, {{0, 300, 10}, {0, 40, 10}, {0, 33, 1}});
  file.bytes.replace(file.begin, std::string::npos, table);
  ExpectRefusal(file.Read(), "states more bytes than lie before it (372) up to chunk 3 of 3");
}

TEST(ChunkTable, IsRefusedWhereAChunkIsShorterThanItsFirstPoint) {
  const TableFile file(RecordWith(10), {{0, 300, 10}, {0, 27, 10}, {0, 60, 1}});
  ExpectRefusal(file.Read(), "27 bytes for chunk 2 of 3 (expected at least 28 for its 10 points)");
}

TEST(ChunkTable, IsRefusedWithMoreOrFewerPointsThanTheHeader) {
  TableFile file(RecordWith(kVariableChunks), {{0, 300, 10}, {0, 40, 7}});
  file.point_count = 16;
  ExpectRefusal(file.Read(), "more points than the header (16) up to chunk 2 of 2");
  file.point_count = 18;
  ExpectRefusal(file.Read(), "17 points in 2 chunks (expected 18");
  TableFile constant = ThreeChunks();
  constant.point_count = 31;
  ExpectRefusal(constant.Read(), "30 points in 3 chunks (expected 31");
}

TEST(ChunkTable, IsRefusedWithChunksBehindTheLastPoint) {
  TableFile file = ThreeChunks();
  file.point_count = 20;
  ExpectRefusal(file.Read(), "32 bytes for chunk 3 of 3 (expected fewer than 28 for its 0 points)");
}

TEST(ChunkTable, IsRefusedWithoutChunksForPoints) {
  TableFile file(RecordWith(50000), {});
  file.point_count = 1;
  ExpectRefusal(file.Read(), "states no chunks for 1 points");
}

}  // namespace
}  // namespace albtpu::laz
