// Layered chunks: what is encoded is decoded, in steps of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "laz/coding/arithmetic_decoder.h"
#include "laz/coding/little_endian.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/point14_fields.h"
#include "laz/items/point_encoders.h"
#include "tests/laz/busy_points.h"

namespace albtpu::laz {
namespace {

using albtpu::testing::BusyRecords;
using albtpu::testing::CalmRecords;

LaszipRecord LayeredRecord(int format, std::size_t extra_bytes, int version = 3) {
  LaszipRecord record = RecordFor(format, albtpu::testing::RecordLength({format, extra_bytes}), kCommonChunkSize);
  for (Item& item : record.items) item.version = static_cast<std::uint16_t>(version);
  return record;
}

absl::Status DecodeInSteps(LayeredDecoder& decoder, const std::string& chunk, std::size_t record_length,
                           std::size_t points, std::size_t step, std::string& records) {
  const MemorySource source(chunk);
  if (absl::Status status = decoder.Begin(source, 0, chunk.size(), points); !status.ok()) return status;
  records.assign(points * record_length, '\xA5');
  for (std::size_t i = 0; i < points; i += step) {
    const std::size_t count = std::min(step, points - i);
    absl::Status status = decoder.Decode({records.data() + i * record_length, count * record_length});
    if (!status.ok()) return status;
  }
  return decoder.End(true);
}

// Of points of format 10 with extra bytes, which have all layers.
class WantedReturns : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 3000;
  std::size_t LayerSize(std::size_t layer) const {
    return Load<std::uint32_t>(chunk_, length_ + sizeof(std::uint32_t) * (1 + layer));
  }
  // Where a layer begins in the chunk.
  std::size_t LayerBegin(std::size_t layer) const {
    std::size_t begin = length_ + sizeof(std::uint32_t) * (1 + kLayers);
    for (std::size_t i = 0; i < layer; ++i) begin += LayerSize(i);
    return begin;
  }

  static constexpr std::size_t kExtraBytes = 5;
  static constexpr std::size_t kLayers = 9 + 2 + 1 + kExtraBytes;
  const LaszipRecord record_ = LayeredRecord(10, kExtraBytes);
  const std::size_t length_ = record_.record_length();
  const std::string records_ = BusyRecords({10, kExtraBytes}, kPoints);
  std::string chunk_ = [this] {
    std::string chunk;
    LayeredEncoder(record_).Encode(records_, chunk, {});
    return chunk;
  }();
  LayeredDecoder all_{record_}, returns_{record_, WantedFields::kReturns};
  std::string decoded_;
};

TEST_F(WantedReturns, AreDecodedAndOtherFieldsAreThoseOfTheFirstPoint) {
  const absl::Status status = DecodeInSteps(returns_, chunk_, length_, kPoints, 700, decoded_);
  ASSERT_TRUE(status.ok()) << status;
  for (std::size_t i = 0; i < kPoints; ++i) {
    std::string expected = records_.substr(0, length_);
    const auto take = [&](std::size_t offset, std::size_t size) {
      std::copy_n(&records_[i * length_ + offset], size, &expected[offset]);
    };
    take(kXOffset, 3 * sizeof(std::int32_t));
    take(kReturnsOffset, 1);
    take(kClassOffset, 1);
    take(kTimeOffset, sizeof(double));
    take(kFlagsOffset, 1);
    ASSERT_EQ(decoded_.substr(i * length_, length_), expected) << i;
  }
}

TEST_F(WantedReturns, AreDecodedWhateverTheOtherLayersAre) {
  std::string sound;
  ASSERT_TRUE(DecodeInSteps(returns_, chunk_, length_, kPoints, kPoints, sound).ok());
  for (const std::size_t layer : {4, 5, 6, 7, 9, 10, 11, 12, 16}) {
    ASSERT_GT(LayerSize(layer), 100u) << layer;
    const std::string kept = chunk_;
    chunk_.replace(LayerBegin(layer), 100, 100, '\xB7');
    EXPECT_TRUE(DecodeInSteps(returns_, chunk_, length_, kPoints, kPoints, decoded_).ok()) << layer;
    EXPECT_TRUE(decoded_ == sound) << layer;
    EXPECT_FALSE(DecodeInSteps(all_, chunk_, length_, kPoints, kPoints, decoded_).ok() && decoded_ == records_)
        << layer;
    chunk_ = kept;
  }
}

TEST_F(WantedReturns, AreFoundToBeDamaged) {
  for (const std::size_t layer : {0, 1, 2, 8}) {
    const std::string kept = chunk_;
    chunk_.replace(LayerBegin(layer), 100, 100, '\xB7');
    const bool decodes = DecodeInSteps(returns_, chunk_, length_, kPoints, kPoints, decoded_).ok();
    std::string all;
    EXPECT_EQ(DecodeInSteps(all_, chunk_, length_, kPoints, kPoints, all).ok(), decodes) << layer;
    EXPECT_FALSE(decodes && all == records_) << layer;
    chunk_ = kept;
  }
}

class LayeredRoundTrip : public ::testing::TestWithParam<std::tuple<int, std::size_t, std::size_t, int>> {};

TEST_P(LayeredRoundTrip, PointsAreDecodedAsTheyWere) {
  const auto [format, extra_bytes, points, version] = GetParam();
  const LaszipRecord record = LayeredRecord(format, extra_bytes, version);
  const std::size_t length = record.record_length();
  LayeredEncoder encoder(record);
  LayeredDecoder decoder(record);
  std::string chunk, decoded;
  // What points are and how many are decoded at a time are independent: a long chunk is decoded in one way only.
  std::vector<std::size_t> steps = {points, 509, std::size_t{points < 2000 ? 1U : 20011U}};
  for (const std::string& records :
       {BusyRecords({format, extra_bytes}, points), CalmRecords({format, extra_bytes}, points),
        BusyRecords({format, extra_bytes}, points, 2)}) {
    encoder.Encode(records, chunk, {});
    for (const std::size_t step : std::span(steps).first(points < 2000 ? steps.size() : 1)) {
      const absl::Status status = DecodeInSteps(decoder, chunk, length, points, step, decoded);
      ASSERT_TRUE(status.ok()) << status;
      ASSERT_TRUE(decoded == records);
    }
    std::rotate(steps.begin(), steps.begin() + 1, steps.end());
  }
}

INSTANTIATE_TEST_SUITE_P(All, LayeredRoundTrip,
                         ::testing::Combine(::testing::Values(6, 7, 8, 9, 10), ::testing::Values(0, 1, 4, 27),
                                            ::testing::Values(1, 2, 1000, 50000), ::testing::Values(3, 4)));

TEST(Layered, TheVersionsOfItemsDifferOnlyWhereScannerChannelsDo) {
  for (const bool busy : {false, true}) {
    const std::string records = busy ? BusyRecords({7, 4}, 1000) : CalmRecords({7, 4}, 1000);
    std::string version3, version4;
    LayeredEncoder(LayeredRecord(7, 4, 3)).Encode(records, version3, {});
    LayeredEncoder(LayeredRecord(7, 4, 4)).Encode(records, version4, {});
    EXPECT_EQ(version3 == version4, !busy);
  }
}

// `records` with further bytes in each, which are those of other records.
std::string WithMoreBytes(const std::string& records, std::size_t length, std::size_t more) {
  const std::size_t points = records.size() / length;
  const std::string others = BusyRecords({6, more}, points, 3);
  std::string longer;
  for (std::size_t i = 0; i < points; ++i) {
    longer += records.substr(i * length, length);
    longer += others.substr((i + 1) * (others.size() / points) - more, more);
  }
  return longer;
}

TEST(CommonLayers, AreThoseOfTheSamePointsWithMoreBytes) {
  for (const int format : {6, 7, 8, 9, 10}) {
    for (const std::size_t bytes : {0, 1, 9}) {
      for (const std::size_t points : {1, 2, 700, 3000}) {
        const LaszipRecord from = LayeredRecord(format, bytes), to = LayeredRecord(format, bytes + 13);
        for (const std::string& records :
             {BusyRecords({format, bytes}, points), CalmRecords({format, bytes}, points)}) {
          const std::string longer = WithMoreBytes(records, from.record_length(), 13);
          std::string original, expected, chunk;
          LayeredEncoder(from).Encode(records, original, {});
          LayeredEncoder(to).Encode(longer, expected, {});
          const std::vector<std::string_view> known = CommonLayers(from, to).Of(original);
          EXPECT_EQ(known.size(),
                    9u + (format == 7 || format == 10) + 2 * (format == 8) + (format >= 9) + (format == 10));
          LayeredEncoder encoder(to);
          encoder.Encode(longer, chunk, known);
          EXPECT_TRUE(chunk == expected) << format << " " << bytes << " " << points;
          encoder.Encode(longer, chunk, {});
          EXPECT_TRUE(chunk == expected) << format << " " << bytes << " " << points;
        }
      }
    }
  }
}

TEST(CommonLayers, AreNoneWhereTheyMayDiffer) {
  const LaszipRecord from = LayeredRecord(7, 4);
  std::string chunk;
  LayeredEncoder(from).Encode(BusyRecords({7, 4}, 1000), chunk, {});
  EXPECT_EQ(CommonLayers(from, from).Of(chunk).size(), 10u);
  for (const LaszipRecord& other : {LayeredRecord(6, 4), LayeredRecord(7, 4, 4), RecordFor(3, 34, kCommonChunkSize)}) {
    EXPECT_TRUE(CommonLayers(from, other).empty());
    EXPECT_TRUE(CommonLayers(other, from).empty());
  }
  const std::size_t sizes = from.record_length() + sizeof(std::uint32_t), begin = sizes + 14 * sizeof(std::uint32_t);
  for (const std::size_t size : {std::size_t{0}, begin - 1, begin, begin + 100})
    EXPECT_TRUE(CommonLayers(from, from).Of(std::string_view(chunk).substr(0, size)).empty()) << size;
  // Of a single point, a layer may be missing that LASzip needs.
  std::string single;
  LayeredEncoder(from).Encode(BusyRecords({7, 4}, 1), single, {});
  EXPECT_EQ(CommonLayers(from, from).Of(single).size(), 10u);
  single.resize(begin);
  Store<std::uint32_t>(0, &single[sizes]);
  Store<std::uint32_t>(0, &single[sizes + sizeof(std::uint32_t)]);
  EXPECT_TRUE(CommonLayers(from, from).Of(single).empty());
}

TEST(Layered, AChunkThatContradictsItselfIsRefused) {
  const LaszipRecord record = LayeredRecord(6, 1);
  std::string chunk, decoded;
  LayeredEncoder(record).Encode(BusyRecords({6, 1}, 100), chunk, {});
  LayeredDecoder decoder(record);
  const auto message = [&](const std::string& bytes, std::size_t points) {
    return std::string(DecodeInSteps(decoder, bytes, 31, points, points, decoded).message());
  };
  EXPECT_EQ(message(chunk, 100), "");
  EXPECT_EQ(message(chunk, 99), "it states 100 points (expected 99); get another copy of the file");
  EXPECT_EQ(message(chunk.substr(0, 50), 100),
            "it has 50 bytes (at least 75 begin a chunk); get another copy of the file");
  EXPECT_EQ(message(chunk + "abc", 100), "it has 3 bytes after its last layer; get another copy of the file");
  EXPECT_EQ(message(chunk.substr(0, chunk.size() - 1), 100),
            "its layer 10 ends 1 bytes behind it; get another copy of the file");
  std::string longer = chunk;
  longer += '\0';
  Store(Load<std::uint32_t>(chunk, 71) + 1, &longer[71]);  // Of layer 10.
  EXPECT_EQ(message(longer, 100), "its layer 10 has 1 bytes after its last point; get another copy of the file");
  std::string shorter = chunk.substr(0, chunk.size() - 1);
  Store(Load<std::uint32_t>(chunk, 71) - 1, &shorter[71]);
  EXPECT_EQ(message(shorter, 100), "its layer 10 ends before its points; get another copy of the file");
}

}  // namespace
}  // namespace albtpu::laz
