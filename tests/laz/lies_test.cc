// Files that lie: about the chunk table, their chunks, their points; and chunks that lie about their points and their
// layers, or are cut anywhere. Each has one clear error, in little memory and time.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "laz/items/chunk_decoder.h"
#include "laz/laz_points.h"
#include "tests/formats/las/las_builder.h"
#include "tests/laz/allocations.h"
#include "tests/laz/laz_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::HasSubstr;
using testing::LazParts;
using ::testing::TestWithParam;
using ::testing::Values;

constexpr std::uint64_t kBegin = 375;                 // Of the points; zeros lie before them.
constexpr std::size_t kPiece = 1000;                  // Points that are read at a time.
constexpr std::uint64_t kFewPoints = 1e6;             // More are not read of files that state more.
constexpr std::size_t kPoints = 20, kExtraBytes = 3;  // Of a single chunk.
constexpr std::size_t kMargin = 4 << 20;              // Bytes that a lie may cost beyond what the truth costs.
// For a file of some hundred bytes, which takes milliseconds, on a busy machine.
constexpr std::chrono::seconds kMostTime(5);

// 40 points in chunks of 10, or of any number.
LazParts Truth(int point_format, bool variable) {
  return testing::TruePoints(point_format, 2, 40,
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

// One number of the file at a time; its error says of what.
TEST_P(Lies, AreNoticed) {
  const std::string whole = file_;
  const LazExtent extent = extent_;
  const auto expect = [&](const char* what, std::initializer_list<std::uint64_t> numbers, const auto& tell) {
    for (const std::uint64_t number : numbers) {
      SCOPED_TRACE(::testing::Message() << what << " " << number);
      file_ = whole;
      extent_ = extent;
      tell(number);
      EXPECT_THAT(Message(), HasSubstr(what));
    }
  };
  const auto state = [&](std::size_t chunk, std::uint64_t Chunk::*member) {
    return [this, chunk, member](std::uint64_t number) {
      std::vector<Chunk> table = truth_.table;
      table[chunk].*member = number;
      State(table);
    };
  };
  const auto move = [&](std::uint64_t Chunk::*member) {  // From one chunk to its neighbour.
    return [this, member](std::uint64_t number) {
      std::vector<Chunk> table = truth_.table;
      table[1].*member += number;
      table[2].*member -= number;
      State(table);
    };
  };
  const std::uint64_t size = whole.size(), all = ~std::uint64_t{0};
  expect("chunk",
         {1, kBegin - 1, kBegin + 1, kBegin + 7, kBegin + 8, table_ - 1, table_ + 1, size - 7, size - 1, size, size + 1,
          std::uint64_t{1} << 63, all - 1},
         [&](std::uint64_t offset) { SetTableOffset(offset); });
  expect("chunk", {0, 1, 3, 5, 0x10000, 0x7FFFFFFF, 0xFFFFFFFF},
         [&](std::uint64_t count) { std::memcpy(file_.data() + table_ + 4, &count, sizeof(std::uint32_t)); });
  for (const std::size_t chunk : {0, 3})
    expect("chunk", {0, 1, 5, 0x7FFFFFFF, 0xFFFFFFFF}, state(chunk, &Chunk::bytes));
  expect("chunk", {all, 1}, move(&Chunk::bytes));
  expect("point", {1, 10, 39, 41, 0xFFFFFFFF, std::uint64_t{1} << 40, all},
         [&](std::uint64_t count) { extent_.point_count = count; });
  if (GetParam().variable) {  // Only tables of chunks of any length state their points.
    expect("point", {0, 4, 6, 0x7FFFFFFF, 0xFFFFFFFF}, state(1, &Chunk::points));
    expect("chunk", {1}, move(&Chunk::points));
  } else {
    expect("chunk", {1, 9, 11, 50000, 0x80000000, 0xFFFFFFFE},
           [&](std::uint64_t points) { extent_.record.chunk_size = static_cast<std::uint32_t>(points); });
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

absl::Status Decode(const LaszipRecord& record, const std::string& bytes, std::uint64_t points, bool exact,
                    std::string* records = nullptr, std::uint64_t* end = nullptr) {
  const MemorySource source(bytes);
  const std::unique_ptr<ChunkDecoder> decoder = ChunkDecoder::For(record);
  testing::ResetMostAllocated();
  absl::Status status = decoder->Begin(source, 0, bytes.size(), points);
  std::string piece(100 * record.record_length(), '\0');
  for (std::uint64_t left = std::min<std::uint64_t>(points, 1000000); status.ok() && left > 0;) {
    piece.resize(std::min<std::uint64_t>(left, 100) * record.record_length());
    status = decoder->Decode(piece);
    if (records != nullptr) *records += piece;
    left -= piece.size() / record.record_length();
  }
  if (status.ok()) status = decoder->End(exact);
  EXPECT_LT(testing::MostAllocated(), bytes.size() + kMargin);
  if (status.ok()) {
    EXPECT_LE(decoder->position(), bytes.size());
    if (end != nullptr) *end = decoder->position();
  } else {
    EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  }
  return status;
}

class ChunkLies : public ::testing::TestWithParam<int> {
 protected:
  const testing::LazParts truth_ = testing::TruePoints(GetParam(), kExtraBytes, kPoints, {kPoints});
  const std::string& chunk_ = truth_.chunks[0];

  bool layered() const { return truth_.record.compressor == Compressor::kLayeredChunked; }
  std::size_t sizes() const { return truth_.record.record_length(); }  // Offset of the number of points.
  std::string Message(const std::string& bytes, std::uint64_t points = kPoints, bool exact = true) {
    return std::string(Decode(truth_.record, bytes, points, exact).message());
  }
};

TEST_P(ChunkLies, AreNotInTheTruth) {
  for (const bool exact : {false, true}) {
    std::string records;
    ASSERT_TRUE(Decode(truth_.record, chunk_, kPoints, exact, &records).ok());
    EXPECT_EQ(records, truth_.records);
  }
}

TEST_P(ChunkLies, OfChunksThatAreCutAnywhereAreNoticed) {
  for (std::size_t size = 0; size < chunk_.size(); ++size) {
    SCOPED_TRACE(size);
    for (const bool exact : {false, true}) EXPECT_NE(Message(chunk_.substr(0, size), kPoints, exact), "");
  }
}

TEST_P(ChunkLies, OfBytesBehindTheirEndAreNoticedWhereItIsKnown) {
  const std::string longer = chunk_ + "x";
  EXPECT_NE(Message(longer), "");
  std::string records;
  std::uint64_t end = 0;
  ASSERT_TRUE(Decode(truth_.record, longer, kPoints, false, &records, &end).ok());
  EXPECT_EQ(records, truth_.records);
  EXPECT_EQ(end, chunk_.size());
}

TEST_P(ChunkLies, OfTooManyPointsAreNoticed) {
  for (const std::uint64_t points : {std::uint64_t{kPoints + 1000}, std::uint64_t{50000}, std::uint64_t{0xFFFFFFFF},
                                     std::uint64_t{1} << 32, (std::uint64_t{1} << 32) + kPoints}) {
    SCOPED_TRACE(points);
    EXPECT_NE(Message(chunk_, points), "");
  }
}

TEST_P(ChunkLies, OfAnotherNumberOfPointsAreNoticedByLayeredChunks) {
  if (!layered()) return;
  for (const std::uint32_t points : {0u, 1u, 19u, 21u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
    SCOPED_TRACE(points);
    std::string bytes = chunk_;
    std::memcpy(bytes.data() + sizes(), &points, sizeof points);
    EXPECT_THAT(Message(bytes), HasSubstr("points"));
  }
}

TEST_P(ChunkLies, OfTheSizesOfLayersAreNoticed) {
  if (!layered()) return;
  const std::size_t layers = 9 + kExtraBytes + (GetParam() == 8 ? 2 : GetParam() == 6 ? 0 : 1);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::size_t at = sizes() + 4 * (1 + layer);
    std::uint32_t size;
    std::memcpy(&size, chunk_.data() + at, sizeof size);
    for (const std::uint32_t lie : {size + 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
      SCOPED_TRACE(::testing::Message() << "layer " << layer << " of " << lie << " bytes instead of " << size);
      std::string bytes = chunk_;
      std::memcpy(bytes.data() + at, &lie, sizeof lie);
      EXPECT_THAT(Message(bytes), HasSubstr("layer"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ChunkLies, ::testing::Range(0, 11),
                         [](const auto& point_format) { return "Format" + std::to_string(point_format.param); });

}  // namespace
}  // namespace albtpu::laz
