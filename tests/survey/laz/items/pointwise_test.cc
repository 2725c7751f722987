#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "survey/laz/coding/little_endian.h"
#include "survey/laz/items/pointwise_decoder.h"
#include "survey/laz/items/pointwise_encoder.h"
#include "tests/survey/laz/busy_points.h"
#include "tests/survey/laz/laz_bytes.h"
#include "tests/survey/laz/laz_sample.h"

namespace albtpu::laz {
namespace {

using albtpu::testing::BusyRecords;
using albtpu::testing::CalmRecords;
using albtpu::testing::RecordLayout;
using albtpu::testing::RecordLength;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// The records of a chunk, decoded `step` at a time.
absl::StatusOr<std::string> Decode(PointwiseDecoder& decoder, std::size_t record_length,
                                   std::string_view chunk, std::size_t points, std::size_t step = 50000) {
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

class Pointwise : public ::testing::TestWithParam<std::tuple<int, std::size_t>> {
 protected:
  RecordLayout layout() const { return {std::get<0>(GetParam()), std::get<1>(GetParam())}; }
};

TEST_P(Pointwise, DecodesChunksAsTheyWereEncoded) {
  const std::size_t length = RecordLength(layout());
  const LaszipRecord record = RecordFor(layout().point_format, length, kCommonChunkSize);
  PointwiseEncoder encoder(record);
  PointwiseDecoder decoder(record);
  std::string chunk;
  const std::string all = BusyRecords(layout(), 50001) + CalmRecords(layout(), 50000);
  // One chunk after the other, by the same coders.
  std::size_t at = 0;
  for (const std::size_t points : {1, 2, 998, 49000, 50000}) {
    const std::string records = all.substr(at * length, points * length);
    at += points;
    encoder.Encode(records, chunk);
    const auto decoded = Decode(decoder, length, chunk, points);
    ASSERT_TRUE(decoded.ok()) << points << " points: " << decoded.status();
    ASSERT_TRUE(*decoded == records) << points;
  }
  EXPECT_EQ(at, 100001u);
}

INSTANTIATE_TEST_SUITE_P(Formats, Pointwise,
                         ::testing::Combine(::testing::Range(0, 6), ::testing::Values(0, 1, 4, 27)));

TEST(PointwiseDecoder, DecodesAsManyPointsAtATimeAsTheCallerLikes) {
  const RecordLayout layout{3, 2};
  const LaszipRecord record = RecordFor(3, 36, kCommonChunkSize);
  const std::string records = BusyRecords(layout, 500);
  std::string chunk;
  PointwiseEncoder(record).Encode(records, chunk);
  PointwiseDecoder decoder(record);
  for (const std::size_t step : {1, 2, 77, 499, 500}) {
    const auto decoded = Decode(decoder, 36, chunk, 500, step);
    ASSERT_TRUE(decoded.ok()) << decoded.status();
    EXPECT_TRUE(*decoded == records) << step;
  }
}

// Chunks that LASzip wrote.
class PointwiseSample : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(PointwiseSample, DecodesToItsTwinAndEncodesToItself) {
  const auto [name, twin_name] = GetParam();
  const std::string file = albtpu::testing::SampleBytes(name);
  if (file.empty()) GTEST_SKIP() << "no sample files (" << name << ")";
  const auto extent = albtpu::testing::ExtentOf(file);
  ASSERT_TRUE(extent.ok()) << extent.status();
  const std::size_t length = extent->record.record_length();
  const auto table =
      ReadChunkTable(MemorySource(file), extent->record, extent->points_begin, extent->point_count);
  ASSERT_TRUE(table.ok()) << table.status();
  PointwiseDecoder decoder(extent->record);
  PointwiseEncoder encoder(extent->record);
  std::string points, encoded;
  for (const Chunk& chunk : table->chunks) {
    const std::string_view bytes = std::string_view(file).substr(chunk.offset, chunk.bytes);
    const auto records = Decode(decoder, length, bytes, chunk.points, 1234);
    ASSERT_TRUE(records.ok()) << records.status();
    points += *records;
    encoder.Encode(*records, encoded);
    EXPECT_TRUE(encoded == bytes) << "the chunk at byte " << chunk.offset;
  }
  EXPECT_EQ(points.size(), extent->point_count * length);
  if (twin_name == nullptr) return;
  EXPECT_TRUE(points == albtpu::testing::TakeApart(albtpu::testing::SampleBytes(twin_name))->points);
}

INSTANTIATE_TEST_SUITE_P(
    Files, PointwiseSample,
    ::testing::Values(std::pair{"1815.laz", "1815.las"}, std::pair{"extrabytes.laz", "extrabytes.las"},
                      std::pair{"point-color.las.laz", "point-color.las"},
                      std::pair{"point-time.las.laz", "point-time.las"},
                      std::pair{"point10.las.laz", "point10.las"}, std::pair{"simple.laz", "simple.las"},
                      std::pair{"plane.laz", nullptr}, std::pair{"autzen_trim.laz", nullptr}));

struct DamagedChunk {
  RecordLayout layout{5, 3};
  std::size_t length = RecordLength(layout), points = 200;
  LaszipRecord record = RecordFor(5, length, kCommonChunkSize);
  std::string records = BusyRecords(layout, points), chunk;
  PointwiseDecoder decoder{record};

  DamagedChunk() { PointwiseEncoder(record).Encode(records, chunk); }
};

TEST(PointwiseDecoder, RefusesChunksCutAnywhere) {
  DamagedChunk cut;
  for (std::size_t size = 0; size < cut.chunk.size(); ++size) {
    const auto decoded = Decode(cut.decoder, cut.length, cut.chunk.substr(0, size), cut.points);
    ASSERT_TRUE(absl::IsDataLoss(decoded.status())) << size << ": " << decoded.status();
    EXPECT_THAT(std::string(decoded.status().message()), EndsWith("; get another copy of the file"));
  }
}

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

TEST(PointwiseDecoder, GivesAnErrorOrOtherPointsForEachFlippedBit) {
  DamagedChunk flipped;
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * flipped.chunk.size(); bit += 3) {
    std::string chunk = flipped.chunk;
    chunk[bit / 8] = static_cast<char>(chunk[bit / 8] ^ 1 << bit % 8);
    const auto decoded = Decode(flipped.decoder, flipped.length, chunk, flipped.points);
    refused += !decoded.ok();
    // The last bytes of a chunk need not matter.
    if (decoded.ok() && bit / 8 + 8 < chunk.size()) {
      EXPECT_FALSE(*decoded == flipped.records) << bit;
    }
  }
  EXPECT_GT(refused, 0);
  // The decoder is as good as new.
  const auto decoded = Decode(flipped.decoder, flipped.length, flipped.chunk, flipped.points);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_TRUE(*decoded == flipped.records);
}

TEST(PointwiseDecoder, EndsForAnyBytes) {
  DamagedChunk damaged;
  std::mt19937 random(1);
  for (int run = 0; run < 300; ++run) {
    std::string chunk(500, run % 2 == 0 ? '\0' : '\xFF');
    for (std::size_t i = 0; run >= 2 && i < chunk.size(); ++i) chunk[i] = static_cast<char>(random());
    const auto decoded = Decode(damaged.decoder, damaged.length, chunk, damaged.points);
    if (!decoded.ok()) {
      EXPECT_TRUE(absl::IsDataLoss(decoded.status())) << decoded.status();
    }
  }
}

}  // namespace
}  // namespace albtpu::laz
