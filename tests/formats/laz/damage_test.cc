// How much damage is noticed. LAZ has no checksum: a flipped bit is noticed when the points no longer end where their
// chunk does. The figures of docs/reliability.md are what these tests print.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "formats/laz/chunk_table.h"
#include "formats/laz/items/chunk_decoder.h"
#include "tests/formats/laz/laz_bytes.h"
#include "tests/formats/laz/laz_sample.h"

namespace albtpu::testing {
namespace {

constexpr std::uint64_t kLongChunk = 1000;  // Points.
// Bits to flip: in chunks that take long to decode, fewer.
constexpr int kFlips = 2000;
constexpr std::uint64_t kFlippedPoints = 4'000'000;

struct Outcomes {
  int refused = 0, other_points = 0, same_points = 0;
};

class LazDamage : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    file_ = SampleBytes(GetParam());
    if (file_.empty()) {
      GTEST_SKIP() << "no sample files (" << GetParam() << ")";
    }
    extent_ = ExtentOf(file_).value();
    table_ = laz::ReadChunkTable(laz::MemorySource(file_), extent_.record, extent_.points_begin, extent_.point_count)
                 .value();
    decoder_ = laz::ChunkDecoder::For(extent_.record);
  }

  absl::Status Decode(const std::string& bytes, std::uint64_t points, std::string& records) const {
    const laz::MemorySource source(bytes);
    records.resize(points * extent_.record.record_length());
    absl::Status status = decoder_->Begin(source, 0, bytes.size(), points);
    if (status.ok()) status = decoder_->Decode(std::span<char>(records));
    return status.ok() ? decoder_->End(true) : status;
  }

  // Flips one random bit of a random chunk at a time.
  Outcomes Flip(int flips) const {
    std::vector<std::string> truths(table_.chunks.size());
    for (std::size_t i = 0; i < truths.size(); ++i) {
      const laz::Chunk& chunk = table_.chunks[i];
      EXPECT_TRUE(Decode(file_.substr(chunk.offset, chunk.bytes), chunk.points, truths[i]).ok());
    }
    std::mt19937_64 random(1);
    Outcomes outcomes;
    std::string records;
    for (int i = 0; i < flips; ++i) {
      const std::size_t number = random() % truths.size();
      const laz::Chunk& chunk = table_.chunks[number];
      std::string bytes = file_.substr(chunk.offset, chunk.bytes);
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

// All but a few flips in 100 change where the points end: those that do not lie in the first record, which is stored as
// it is, or in bits that are stored as they are, behind the modelled ones of large differences.
TEST_P(LazDamage, OfOneBitIsMostlyNoticedInLongChunks) {
  const std::uint64_t points = extent_.point_count / table_.chunks.size();
  const int flips = static_cast<int>(std::min<std::uint64_t>(kFlips, 1 + kFlippedPoints / points));
  const Outcomes outcomes = Flip(flips);
  std::cout << GetParam() << ": " << points << " points a chunk; of " << flips << " flips " << outcomes.refused
            << " refused, " << outcomes.other_points << " other points, " << outcomes.same_points
            << " the same points\n";
  if (points >= kLongChunk) {
    EXPECT_GE(outcomes.refused, flips * 97 / 100);
  }
}

// A flipped bit of the table is refused, or the chunks that it states cannot be decoded, or it changes nothing.
TEST_P(LazDamage, OfTheChunkTableChangesNoPoint) {
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
  std::cout << GetParam() << ": of " << refused + harmless << " flips in the table " << refused << " refused, "
            << harmless << " harmless\n";
  EXPECT_GT(refused, harmless);
}

INSTANTIATE_TEST_SUITE_P(Samples, LazDamage,
                         ::testing::Values("1815.laz", "extrabytes.laz", "plane.laz", "point10.las.laz",
                                           "autzen_trim.laz", "1_4_w_evlr.laz", "append-bug.laz", "simple.copc.laz"),
                         [](const auto& sample) {
                           std::string name = sample.param;
                           std::ranges::replace_if(
                               name, [](char c) { return c == '.' || c == '-'; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace albtpu::testing
