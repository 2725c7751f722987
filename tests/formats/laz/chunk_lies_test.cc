// Chunks that lie: about their points and their layers, or cut anywhere. Each has one clear error.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include "formats/laz/items/chunk_decoder.h"
#include "tests/formats/las/las_builder.h"
#include "tests/formats/laz/allocations.h"
#include "tests/formats/laz/laz_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kPoints = 20, kExtraBytes = 3;
constexpr std::size_t kMargin = 4 << 20;  // Bytes that a lie may cost.

struct TrueChunk {
  explicit TrueChunk(int point_format) {
    testing::LasSpec spec;
    spec.point_format = point_format;
    spec.extra_bytes = kExtraBytes;
    for (int i = 0; i < static_cast<int>(kPoints); ++i)
      spec.points.push_back({.x = 30 * i, .y = i * i, .z = i % 5, .gps_time = i / 2 * 0.1});
    const std::size_t length = testing::PointSize(point_format) + kExtraBytes;
    const std::string file = testing::BuildLas(spec);
    testing::LazParts parts =
        testing::CompressPoints(point_format, length, file.substr(file.size() - kPoints * length), {kPoints});
    record = parts.record;
    records = parts.records;
    bytes = parts.chunks[0];
  }

  LaszipRecord record;
  std::string records, bytes;
};

absl::Status Decode(const LaszipRecord& record, const std::string& bytes, std::uint64_t points, bool exact,
                    std::string* records = nullptr) {
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
  } else
    EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  return status;
}

class ChunkLies : public ::testing::TestWithParam<int> {
 protected:
  TrueChunk chunk_{GetParam()};

  bool layered() const { return chunk_.record.compressor == Compressor::kLayeredChunked; }
  std::size_t sizes() const { return chunk_.record.record_length(); }  // Offset of the number of points.
  std::string Message(const std::string& bytes, std::uint64_t points = kPoints, bool exact = true) {
    return std::string(Decode(chunk_.record, bytes, points, exact).message());
  }
};

TEST_P(ChunkLies, AreNotInTheTruth) {
  for (const bool exact : {false, true}) {
    std::string records;
    ASSERT_TRUE(Decode(chunk_.record, chunk_.bytes, kPoints, exact, &records).ok());
    EXPECT_EQ(records, chunk_.records);
  }
}

TEST_P(ChunkLies, OfChunksThatAreCutAnywhereAreNoticed) {
  for (std::size_t size = 0; size < chunk_.bytes.size(); ++size) {
    SCOPED_TRACE(size);
    for (const bool exact : {false, true}) EXPECT_NE(Message(chunk_.bytes.substr(0, size), kPoints, exact), "");
  }
}

TEST_P(ChunkLies, OfBytesBehindTheirEndAreNoticedWhereItIsKnown) {
  const std::string longer = chunk_.bytes + "x";
  EXPECT_NE(Message(longer), "");
  std::string records;
  ASSERT_TRUE(Decode(chunk_.record, longer, kPoints, false, &records).ok());
  EXPECT_EQ(records, chunk_.records);
}

TEST_P(ChunkLies, OfTooManyPointsAreNoticed) {
  for (const std::uint64_t points : {std::uint64_t{kPoints + 1000}, std::uint64_t{50000}, std::uint64_t{0xFFFFFFFF},
                                     std::uint64_t{1} << 32, (std::uint64_t{1} << 32) + kPoints}) {
    SCOPED_TRACE(points);
    EXPECT_NE(Message(chunk_.bytes, points), "");
  }
}

TEST_P(ChunkLies, OfAnotherNumberOfPointsAreNoticedByLayeredChunks) {
  if (!layered()) return;
  for (const std::uint32_t points : {0u, 1u, 19u, 21u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
    SCOPED_TRACE(points);
    std::string bytes = chunk_.bytes;
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
    std::memcpy(&size, chunk_.bytes.data() + at, sizeof size);
    for (const std::uint32_t lie : {size + 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
      SCOPED_TRACE(::testing::Message() << "layer " << layer << " of " << lie << " bytes instead of " << size);
      std::string bytes = chunk_.bytes;
      std::memcpy(bytes.data() + at, &lie, sizeof lie);
      EXPECT_THAT(Message(bytes), HasSubstr("layer"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ChunkLies, ::testing::Range(0, 11),
                         [](const auto& point_format) { return "Format" + std::to_string(point_format.param); });

}  // namespace
}  // namespace albtpu::laz
