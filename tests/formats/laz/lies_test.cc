// Files that lie: about the chunk table, their chunks, their points. Each has one clear error, in little memory and
// time.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "formats/laz/laz_points.h"
#include "tests/formats/las/las_builder.h"
#include "tests/formats/laz/allocations.h"
#include "tests/formats/laz/laz_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::HasSubstr;
using testing::LazParts;
using ::testing::TestWithParam;
using ::testing::Values;

constexpr std::uint64_t kBegin = 375;      // Of the points; zeros lie before them.
constexpr std::size_t kPiece = 1000;       // Points that are read at a time.
constexpr std::uint64_t kFewPoints = 1e6;  // More are not read of files that state more.
constexpr std::size_t kMargin = 4 << 20;   // Bytes that a lie may cost beyond what the truth costs.
// For a file of some hundred bytes, which takes milliseconds, on a busy machine.
constexpr std::chrono::seconds kMostTime(5);

std::string Records(int point_format, int count) {
  testing::LasSpec spec;
  spec.point_format = point_format;
  spec.extra_bytes = 2;
  for (int i = 0; i < count; ++i) spec.points.push_back({.x = 30 * i, .y = i * i, .z = i % 5, .gps_time = i / 2 * 0.1});
  const std::string file = testing::BuildLas(spec);
  return file.substr(file.size() - static_cast<std::size_t>(count) * (testing::PointSize(point_format) + 2));
}

// 40 points in chunks of 10, or of any number.
LazParts Truth(int point_format, bool variable) {
  return testing::CompressPoints(point_format, testing::PointSize(point_format) + 2, Records(point_format, 40),
                                 variable ? std::vector<std::size_t>{10, 5, 20, 5} : std::vector<std::size_t>(4, 10));
}

std::string File(const LazParts& parts) { return std::string(kBegin, '\0') + testing::PointsSection(parts, kBegin); }

absl::Status ReadAll(const std::string& file, const LazExtent& extent, std::string* records = nullptr) {
  const MemorySource source(file);
  const absl::StatusOr<std::unique_ptr<LazPoints>> points = LazPoints::Open(source, extent, 1);
  if (!points.ok()) return points.status();
  const std::size_t length = extent.record.record_length();
  std::string piece;
  for (std::uint64_t left = std::min(extent.point_count, kFewPoints); left > 0;) {
    piece.resize(std::min<std::uint64_t>(left, kPiece) * length);
    if (const absl::Status status = (*points)->Read(piece); !status.ok()) return status;
    if (records != nullptr) *records += piece;
    left -= piece.size() / length;
  }
  EXPECT_LE((*points)->end(), extent.points_end);
  return absl::OkStatus();
}

LazExtent Extent(const LazParts& parts, const std::string& file) {
  return {
      .record = parts.record, .points_begin = kBegin, .point_count = parts.point_count(), .points_end = file.size()};
}

struct Kind {
  int point_format;
  bool variable;
};

// Compressor 2 and 3, chunks of constant and of any length.
class Lies : public TestWithParam<Kind> {
 protected:
  LazParts truth_ = Truth(GetParam().point_format, GetParam().variable);
  std::string file_ = File(truth_);
  LazExtent extent_ = Extent(truth_, file_);
  std::uint64_t table_ = kBegin + 8 + [this] {
    std::uint64_t bytes = 0;
    for (const std::string& chunk : truth_.chunks) bytes += chunk.size();
    return bytes;
  }();

  // What the true file costs.
  std::size_t CostOfTruth() {
    testing::ResetMostAllocated();
    EXPECT_TRUE(ReadAll(File(truth_), Extent(truth_, File(truth_))).ok());
    return testing::MostAllocated();
  }

  // The error of the file as it is now. Fails when it takes long or much memory.
  absl::Status Error() {
    testing::ResetMostAllocated();
    const auto begin = std::chrono::steady_clock::now();
    const absl::Status status = ReadAll(file_, extent_);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, kMostTime);
    EXPECT_LT(testing::MostAllocated(), cost_ + kMargin);
    if (!status.ok()) {
      EXPECT_TRUE(absl::IsInvalidArgument(status) || absl::IsDataLoss(status)) << status;
      EXPECT_THAT(std::string(status.message()), HasSubstr("; get "));  // What to do.
    }
    return status;
  }

  std::string Message() { return std::string(Error().message()); }

  void SetTableOffset(std::uint64_t offset) { std::memcpy(file_.data() + kBegin, &offset, sizeof offset); }

  void State(const std::vector<Chunk>& table) {
    LazParts lie = truth_;
    lie.table = table;
    file_ = File(lie);
    extent_.points_end = file_.size();
  }

  std::size_t cost_ = CostOfTruth();
};

TEST_P(Lies, AreNotInTheTruth) {
  std::string records;
  ASSERT_TRUE(ReadAll(file_, extent_, &records).ok());
  EXPECT_EQ(records, truth_.records);
}

TEST_P(Lies, OfTheOffsetOfTheTableAreNoticed) {
  for (const std::uint64_t offset :
       {std::uint64_t{1}, kBegin - 1, kBegin + 1, kBegin + 7, kBegin + 8, table_ - 1, table_ + 1, file_.size() - 7,
        file_.size() - 1, file_.size(), file_.size() + 1, std::uint64_t{1} << 63, ~std::uint64_t{1}}) {
    SCOPED_TRACE(offset);
    SetTableOffset(offset);
    EXPECT_THAT(Message(), HasSubstr("chunk"));
  }
}

// Where the writer was stopped before the table, or wrote to a pipe: the chunks are read one after the other.
TEST_P(Lies, OfNoTableAreToldFromLies) {
  for (const std::uint64_t offset : {std::uint64_t{0}, kBegin, ~std::uint64_t{0}}) {
    SCOPED_TRACE(offset);
    SetTableOffset(offset);
    std::string records;
    const absl::Status status = ReadAll(file_, extent_, &records);
    if (GetParam().variable) {
      EXPECT_THAT(std::string(status.message()), HasSubstr("no chunk table"));
    } else {
      EXPECT_TRUE(status.ok()) << status;
      EXPECT_EQ(records, truth_.records);
    }
  }
}

TEST_P(Lies, OfTheNumberOfChunksAreNoticed) {
  for (const std::uint32_t count : {0u, 1u, 3u, 5u, 0x10000u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
    SCOPED_TRACE(count);
    std::memcpy(file_.data() + table_ + 4, &count, sizeof count);
    EXPECT_THAT(Message(), HasSubstr("chunk"));
  }
}

TEST_P(Lies, OfTheBytesOfAChunkAreNoticed) {
  for (const std::uint64_t bytes : {0u, 1u, 5u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
    for (const std::size_t chunk : {0u, 3u}) {
      SCOPED_TRACE(::testing::Message() << "chunk " << chunk << ": " << bytes << " bytes");
      std::vector<Chunk> table = truth_.table;
      table[chunk].bytes = bytes;
      State(table);
      EXPECT_THAT(Message(), HasSubstr("chunk"));
    }
  }
}

TEST_P(Lies, ThatMoveBytesFromChunkToChunkAreNoticed) {
  for (const std::uint64_t by : {~std::uint64_t{0}, std::uint64_t{1}}) {
    SCOPED_TRACE(by);
    std::vector<Chunk> table = truth_.table;
    table[1].bytes += by;
    table[2].bytes -= by;
    State(table);
    EXPECT_THAT(Message(), HasSubstr("chunk"));
  }
}

TEST_P(Lies, OfTheNumberOfPointsAreNoticed) {
  for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{10}, std::uint64_t{39}, std::uint64_t{41},
                                    std::uint64_t{0xFFFFFFFF}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    SCOPED_TRACE(count);
    extent_.point_count = count;
    EXPECT_THAT(Message(), HasSubstr("point"));
  }
}

TEST_P(Lies, OfThePointsOfAChunkAreNoticed) {
  if (!GetParam().variable) return;  // Only tables of chunks of any length state them.
  for (const std::uint64_t points : {0u, 4u, 6u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
    SCOPED_TRACE(points);
    std::vector<Chunk> table = truth_.table;
    table[1].points = points;
    State(table);
    EXPECT_THAT(Message(), HasSubstr("point"));
  }
  std::vector<Chunk> table = truth_.table;
  ++table[1].points;
  --table[2].points;
  State(table);
  EXPECT_THAT(Message(), HasSubstr("chunk"));
}

TEST_P(Lies, OfTheChunkSizeAreNoticed) {
  if (GetParam().variable) return;
  for (const std::uint32_t size : {1u, 9u, 11u, 50000u, 0x80000000u, 0xFFFFFFFEu}) {
    SCOPED_TRACE(size);
    extent_.record.chunk_size = size;
    EXPECT_THAT(Message(), HasSubstr("chunk"));
  }
}

TEST_P(Lies, AreNoticedWithoutATableToo) {
  SetTableOffset(~std::uint64_t{0});
  file_.resize(table_);
  extent_.points_end = file_.size();
  if (GetParam().variable) {
    EXPECT_THAT(Message(), HasSubstr("chunk"));  // Nothing says where a chunk ends.
    return;
  }
  std::string records;
  ASSERT_TRUE(ReadAll(file_, extent_, &records).ok());
  EXPECT_EQ(records, truth_.records);
  extent_.point_count = 0xFFFFFFFF;
  EXPECT_THAT(Message(), HasSubstr("chunk"));
  extent_.record.chunk_size = 0xFFFFFFFE;
  EXPECT_THAT(Message(), HasSubstr("chunk"));
}

// A file that ends early has no points that it does not have.
TEST_P(Lies, OfFilesThatAreCutAnywhereAreNoticed) {
  const std::string whole = file_;
  for (std::size_t size = kBegin; size < whole.size(); ++size) {
    SCOPED_TRACE(size);
    file_ = whole.substr(0, size);
    extent_.points_end = size;
    const absl::Status status = Error();
    // Behind the chunks, what is cut are last bytes of the table that its decoder does not need.
    EXPECT_TRUE(!status.ok() || size + 4 >= whole.size()) << status;
  }
}

TEST_P(Lies, OfASingleBitAreNoticedOrGiveTheNumberOfPointsThatIsStated) {
  const std::string whole = file_;
  for (std::size_t bit = 8 * kBegin; bit < 8 * whole.size(); ++bit) {
    SCOPED_TRACE(bit);
    file_ = whole;
    file_[bit / 8] = static_cast<char>(file_[bit / 8] ^ 1 << bit % 8);
    Message();
  }
}

// The longest records have models for 65 535 bytes in each of four scanner channels: for one thread, not for eight.
TEST(LongRecords, TakeTheMemoryOfOneThread) {
  constexpr std::size_t kLength = 0xFFFF, kCount = 64;
  std::string records(kCount * kLength, '\0');
  for (std::size_t i = 0; i < kCount; ++i) {
    char* const record = &records[i * kLength];
    std::memset(record + testing::PointSize(6), static_cast<int>(i), kLength - testing::PointSize(6));
    record[15] = static_cast<char>(i % 4 << 4);
  }
  const LazParts parts = testing::CompressPoints(6, kLength, records, std::vector<std::size_t>(8, 8));
  const std::string file = File(parts);
  testing::ResetMostAllocated();
  const MemorySource source(file);
  const auto points = LazPoints::Open(source, Extent(parts, file), 8);
  std::string read(records.size(), '\0');
  ASSERT_TRUE((*points)->Read(read).ok());
  EXPECT_TRUE(read == records);
  EXPECT_LT(testing::MostAllocated(), std::size_t{500} << 20);
  RecordProperty("MB", static_cast<int>(testing::MostAllocated() >> 20));
}

std::string Name(const ::testing::TestParamInfo<Kind>& info) {
  return "Format" + std::to_string(info.param.point_format) + (info.param.variable ? "AnyLength" : "");
}

INSTANTIATE_TEST_SUITE_P(Files, Lies, Values(Kind{1, false}, Kind{3, true}, Kind{6, false}, Kind{8, true}), Name);

}  // namespace
}  // namespace albtpu::laz
