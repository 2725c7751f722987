#include <gmock/gmock.h>

#include "formats/laz/coding/little_endian.h"
#include "formats/laz/items/chunk_decoder.h"
#include "formats/laz/items/point_encoders.h"
#include "tests/formats/laz/busy_points.h"
#include "tests/formats/laz/laz_bytes.h"
#include "tests/formats/laz/laz_sample.h"

namespace albtpu::laz {
namespace {

using albtpu::testing::BusyRecords;
using albtpu::testing::RecordLayout;
using albtpu::testing::RecordLength;
using ::testing::HasSubstr;

// The records of a chunk, decoded `step` at a time.
absl::StatusOr<std::string> Decode(PointwiseDecoder& decoder, std::size_t record_length, std::string_view chunk,
                                   std::size_t points, std::size_t step = 50000) {
  const MemorySource source(chunk);
  if (absl::Status status = decoder.Begin(source, 0, chunk.size(), points); !status.ok()) return status;
  std::string records(points * record_length, '\0');
  for (std::size_t at = 0; at < points; at += step) {
    const std::size_t size = std::min(step, points - at) * record_length;
    absl::Status status = decoder.Decode({records.data() + at * record_length, size});
    if (!status.ok()) return status;
  }
  if (absl::Status status = decoder.End(true); !status.ok()) return status;
  return records;
}

// Chunks that LASzip wrote.
class PointwiseSample : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(PointwiseSample, DecodesToItsTwinAndEncodesToItself) {
  const auto [name, twin_name] = GetParam();
  const std::string file = albtpu::testing::SampleBytes(name);
  if (file.empty()) {
    GTEST_SKIP() << "no sample files (" << name << ")";
  }
  const auto extent = albtpu::testing::ExtentOf(file);
  const std::size_t length = extent->record.record_length();
  const auto table = ReadChunkTable(MemorySource(file), extent->record, extent->points_begin, extent->point_count);
  PointwiseDecoder decoder(extent->record);
  PointwiseEncoder encoder(extent->record);
  std::string points, encoded;
  for (const Chunk& chunk : table->chunks) {
    const std::string_view bytes = std::string_view(file).substr(chunk.offset, chunk.bytes);
    const auto records = Decode(decoder, length, bytes, chunk.points, 1234);
    points += *records;
    encoder.Encode(*records, encoded);
    EXPECT_TRUE(encoded == bytes) << "the chunk at byte " << chunk.offset;
  }
  EXPECT_EQ(points.size(), extent->point_count * length);
  if (twin_name == nullptr) return;
  EXPECT_TRUE(points == albtpu::testing::TakeApart(albtpu::testing::SampleBytes(twin_name))->points);
}

INSTANTIATE_TEST_SUITE_P(Files, PointwiseSample,
                         ::testing::Values(std::pair{"1815.laz", "1815.las"},
                                           std::pair{"extrabytes.laz", "extrabytes.las"},
                                           std::pair{"point-color.las.laz", "point-color.las"},
                                           std::pair{"point-time.las.laz", "point-time.las"},
                                           std::pair{"point10.las.laz", "point10.las"},
                                           std::pair{"simple.laz", "simple.las"}, std::pair{"plane.laz", nullptr},
                                           std::pair{"autzen_trim.laz", nullptr}));

struct DamagedChunk {
  RecordLayout layout{5, 3};
  std::size_t length = RecordLength(layout), points = 200;
  LaszipRecord record = RecordFor(5, length, kCommonChunkSize);
  std::string records = BusyRecords(layout, points), chunk;
  PointwiseDecoder decoder{record};

  DamagedChunk() { PointwiseEncoder(record).Encode(records, chunk); }
};

TEST(PointwiseDecoder, RefusesBytesBehindThePoints) {
  DamagedChunk longer;
  longer.chunk += '\0';
  const auto decoded = Decode(longer.decoder, longer.length, longer.chunk, longer.points);
  EXPECT_TRUE(absl::IsDataLoss(decoded.status()));
  EXPECT_THAT(std::string(decoded.status().message()), HasSubstr("its points end after "));
}

TEST(PointwiseDecoder, FindsTheEndOfAChunkByItself) {
  DamagedChunk longer;
  const std::size_t size = longer.chunk.size();
  longer.chunk += "the next chunk";
  const MemorySource source(longer.chunk);
  ASSERT_TRUE(longer.decoder.Begin(source, 0, longer.chunk.size(), longer.points).ok());
  std::string records(longer.records.size(), '\0');
  ASSERT_TRUE(longer.decoder.Decode(records).ok());
  EXPECT_TRUE(longer.decoder.End(false).ok());
  EXPECT_EQ(longer.decoder.position(), size);
  EXPECT_TRUE(records == longer.records);
}

}  // namespace
}  // namespace albtpu::laz
