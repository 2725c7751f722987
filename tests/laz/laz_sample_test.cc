// LAZ files that other programs wrote, against the same points uncompressed, and how much damage of them is noticed.
// LAZ has no checksum: a flipped bit is noticed when the points no longer end where their chunk does. The figures of
// docs/reliability.md are what these tests print. The files may lie beside the checkout.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "laz/chunk_table.h"
#include "laz/coding/little_endian.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/point_encoders.h"
#include "tests/laz/laz_bytes.h"

namespace albtpu::testing {
namespace {

// The bytes of a sample, which may be compressed by gzip; "" if it is absent.
std::string SampleBytes(const std::string& name) {
  const std::string path = std::string(ALBTPU_LAZ_SAMPLES) + "/" + name;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  std::string bytes;
  if (!file) return bytes;
  std::vector<char> piece(1 << 20);
  for (int size = 0; (size = gzread(file.get(), piece.data(), 1 << 20)) > 0;)
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  return bytes;
}

constexpr std::uint64_t kLongChunk = 1000;  // Points.
// Bits to flip: in chunks that take long to decode, fewer.
constexpr int kFlips = 1000;
constexpr std::uint64_t kFlippedPoints = 2'000'000;

struct Outcomes {
  int refused = 0, other_points = 0, same_points = 0;
};

struct Sample {
  std::string name, twin;  // The twin is empty where there is none.
  std::size_t points;
};

void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

class LazSample : public ::testing::TestWithParam<Sample> {
 protected:
  void SetUp() override {
    file_ = SampleBytes(GetParam().name);
    if (file_.empty()) {
      GTEST_SKIP() << "no sample files (" << GetParam().name << ")";
    }
    extent_ = ExtentOf(file_).value();
    table_ = laz::ReadChunkTable(laz::MemorySource(file_), extent_.record, extent_.points_begin, extent_.point_count)
                 .value();
    decoder_ = laz::ChunkDecoder::For(extent_.record);
  }

  // The records of a chunk with these bytes, decoded 777 at a time.
  absl::Status Decode(const std::string& bytes, std::uint64_t points, std::string& records) const {
    const laz::MemorySource source(bytes);
    records.resize(points * extent_.record.record_length());
    const std::size_t step = 777 * extent_.record.record_length();
    absl::Status status = decoder_->Begin(source, 0, bytes.size(), points);
    for (std::size_t at = 0; at < records.size() && status.ok(); at += step)
      status = decoder_->Decode({records.data() + at, std::min(step, records.size() - at)});
    return status.ok() ? decoder_->End(true) : status;
  }
  std::string BytesOf(const laz::Chunk& chunk) const { return file_.substr(chunk.offset, chunk.bytes); }

  // Flips one random bit of a random chunk at a time.
  Outcomes Flip(int flips) const {
    std::vector<std::string> truths(table_.chunks.size());
    for (std::size_t i = 0; i < truths.size(); ++i) {
      const laz::Chunk& chunk = table_.chunks[i];
      EXPECT_TRUE(Decode(BytesOf(chunk), chunk.points, truths[i]).ok());
    }
    std::mt19937_64 random(1);
    Outcomes outcomes;
    std::string records;
    for (int i = 0; i < flips; ++i) {
      const std::size_t number = random() % truths.size();
      const laz::Chunk& chunk = table_.chunks[number];
      std::string bytes = BytesOf(chunk);
      const std::uint64_t bit = random() % (8 * bytes.size());
      bytes[bit / 8] ^= static_cast<char>(1 << bit % 8);
      if (!Decode(bytes, chunk.points, records).ok())
        ++outcomes.refused;
      else
        ++(records == truths[number] ? outcomes.same_points : outcomes.other_points);
    }
    return outcomes;
  }

  std::string file_;
  laz::LazExtent extent_;
  laz::ChunkTable table_;
  std::unique_ptr<laz::ChunkDecoder> decoder_;
};

TEST_P(LazSample, HasThePointsOfItsTwin) {
  const auto parts = TakeApart(file_);
  EXPECT_EQ(parts->points.size(), GetParam().points * parts->record_length());
  EXPECT_TRUE(TakeApart(file_, 2)->points == parts->points);
  if (GetParam().twin.empty()) return;
  const std::string twin = SampleBytes(GetParam().twin);
  ASSERT_FALSE(twin.empty());
  EXPECT_TRUE(parts->points == TakeApart(twin)->points);
}

TEST_P(LazSample, HasChunksAndATableThatAreWrittenAgainByteForByte) {
  EXPECT_EQ(table_.chunks.back().offset + table_.chunks.back().bytes, table_.begin);
  EXPECT_EQ(ChunkTableBytes(extent_.record, table_.chunks), file_.substr(table_.begin, table_.end - table_.begin));
  const auto encoder = laz::ChunkEncoder::For(extent_.record);
  std::string records, again;
  for (const laz::Chunk& chunk : table_.chunks) {
    ASSERT_TRUE(Decode(BytesOf(chunk), chunk.points, records).ok());
    encoder->Encode(records, again, {});
    EXPECT_TRUE(BytesOf(chunk) == again) << "the chunk at byte " << chunk.offset;
  }
}

TEST_P(LazSample, WrittenAgainIsTheSameAndAsSmall) {
  const auto parts = TakeApart(file_);
  const std::string again = AsLaz(*parts);
  const auto parts_again = TakeApart(again);
  EXPECT_TRUE(AsLas(*parts_again) == AsLas(*parts));
  const double ratio = static_cast<double>(again.size()) / static_cast<double>(file_.size());
  if (GetParam().name == "simple.copc.laz") {
    EXPECT_LT(ratio, 1);  // Its many small chunks become one.
  } else {
    EXPECT_NEAR(ratio, 1, 0.01);
  }
}

// All but a few flips in 100 change where the points end: those that do not lie in the first record, which is stored as
// it is, or in bits that are stored as they are, behind the modelled ones of large differences.
TEST_P(LazSample, NoticesMostDamageOfOneBitInLongChunks) {
  const std::uint64_t points = extent_.point_count / table_.chunks.size();
  const int flips = static_cast<int>(std::min<std::uint64_t>(kFlips, 1 + kFlippedPoints / points));
  const Outcomes outcomes = Flip(flips);
  std::cout << GetParam().name << ": " << points << " points a chunk; of " << flips << " flips " << outcomes.refused
            << " refused, " << outcomes.other_points << " other points, " << outcomes.same_points
            << " the same points\n";
  if (points >= kLongChunk) {
    EXPECT_GE(outcomes.refused, flips * 97 / 100);
  }
}

// A flipped bit of the table is refused, or the chunks that it states cannot be decoded, or it changes nothing.
TEST_P(LazSample, ChangesNoPointByDamageOfTheChunkTable) {
  const auto truth = TakeApart(file_);
  int refused = 0, harmless = 0;
  for (std::uint64_t bit = 8 * table_.begin; bit < 8 * table_.end; ++bit) {
    std::string damaged = file_;
    damaged[bit / 8] ^= static_cast<char>(1 << bit % 8);
    const auto parts = TakeApart(damaged);
    ++(parts.ok() ? harmless : refused);
    if (!parts.ok()) continue;
    EXPECT_TRUE(parts->points == truth->points) << "bit " << bit - 8 * table_.begin;
  }
  std::cout << GetParam().name << ": of " << refused + harmless << " flips in the table " << refused << " refused, "
            << harmless << " harmless\n";
  EXPECT_GT(refused, harmless);
}

INSTANTIATE_TEST_SUITE_P(
    , LazSample,
    ::testing::Values(Sample{"1815.laz", "1815.las", 1247}, Sample{"1_4_w_evlr.laz", "1_4_w_evlr.las", 1000},
                      Sample{"append-bug.laz", "", 37805}, Sample{"autzen_trim.laz", "autzen_trim.las.gz", 110000},
                      Sample{"extrabytes.laz", "extrabytes.las", 1065}, Sample{"plane.laz", "", 28185},
                      Sample{"point-color.las.laz", "point-color.las", 1065},
                      Sample{"point-time.las.laz", "point-time.las", 1065},
                      Sample{"point10.las.laz", "point10.las", 1065}, Sample{"simple.copc.laz", "", 1065},
                      Sample{"simple.laz", "simple.las", 1065}),
    [](const auto& parameter) {
      std::string name = parameter.param.name;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
      return name;
    });

// x, y, z in cm, return number, class, intensity, time and colours of a record.
using Values = std::tuple<long, long, long, int, int, std::string, std::string>;

std::vector<Values> SortedPoints(const LasParts& parts) {
  const bool modern = parts.point_format() >= 6;
  const std::size_t time = modern ? 22 : 20;
  std::vector<Values> points;
  for (std::size_t at = 0; at < parts.points.size(); at += parts.record_length()) {
    const auto centimetres = [&](std::size_t axis) {
      const auto steps = laz::Load<std::int32_t>(parts.points, at + 4 * axis);
      const auto scale = laz::Load<double>(parts.header, 131 + 8 * axis);
      return std::lround(100 * (steps * scale + laz::Load<double>(parts.header, 155 + 8 * axis)));
    };
    const int returns = parts.points[at + 14], point_class = parts.points[at + (modern ? 16 : 15)];
    points.emplace_back(centimetres(0), centimetres(1), centimetres(2), returns & (modern ? 15 : 7),
                        point_class & (modern ? 0xFF : 31), parts.points.substr(at + 12, 2),
                        parts.points.substr(at + time, 14));
  }
  std::sort(points.begin(), points.end());
  return points;
}

// Its chunks are of any size: those of the octree's nodes.
TEST(CopcSample, HasThePointsOfItsTwinInAnotherOrder) {
  const std::string file = SampleBytes("simple.copc.laz");
  if (file.empty()) {
    GTEST_SKIP() << "no sample files (simple.copc.laz)";
  }
  const auto parts = TakeApart(file);
  const auto twin = TakeApart(SampleBytes("simple.las"));
  EXPECT_EQ(SortedPoints(*parts).size(), 1065u);
  EXPECT_TRUE(SortedPoints(*parts) == SortedPoints(*twin));
}

TEST(SampleOfTheFirstCompressor, IsRefused) {
  const std::string file = SampleBytes("simple-laszip-compressor-version-1.2r0.laz");
  if (file.empty()) {
    GTEST_SKIP() << "no sample files";
  }
  const auto parts = TakeApart(file);
  EXPECT_EQ(parts.status().code(), absl::StatusCode::kUnimplemented);
  EXPECT_NE(parts.status().message().find("version 1"), std::string::npos) << parts.status();
}

}  // namespace
}  // namespace albtpu::testing
