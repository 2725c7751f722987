#include "laz/items/laszip_record.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <string>

#include "laz/coding/little_endian.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(LaszipRecord, HasTheItemsOfEachPointFormat) {
  const Item point{ItemType::kPoint10, 20, 2}, time{ItemType::kGpsTime11, 8, 2}, rgb{ItemType::kRgb12, 6, 2},
      packet{ItemType::kWavePacket13, 29, 1}, point14{ItemType::kPoint14, 30, 3}, rgb14{ItemType::kRgb14, 6, 3},
      nir{ItemType::kRgbNir14, 8, 3}, packet14{ItemType::kWavePacket14, 29, 3};
  EXPECT_THAT(RecordFor(0, 20, 50000).items, ElementsAre(point));
  EXPECT_THAT(RecordFor(1, 28, 50000).items, ElementsAre(point, time));
  EXPECT_THAT(RecordFor(2, 26, 50000).items, ElementsAre(point, rgb));
  EXPECT_THAT(RecordFor(3, 34, 50000).items, ElementsAre(point, time, rgb));
  EXPECT_THAT(RecordFor(4, 57, 50000).items, ElementsAre(point, time, packet));
  EXPECT_THAT(RecordFor(5, 63, 50000).items, ElementsAre(point, time, rgb, packet));
  EXPECT_THAT(RecordFor(6, 30, 50000).items, ElementsAre(point14));
  EXPECT_THAT(RecordFor(7, 36, 50000).items, ElementsAre(point14, rgb14));
  EXPECT_THAT(RecordFor(8, 38, 50000).items, ElementsAre(point14, nir));
  EXPECT_THAT(RecordFor(9, 59, 50000).items, ElementsAre(point14, packet14));
  EXPECT_THAT(RecordFor(10, 67, 50000).items, ElementsAre(point14, nir, packet14));
  EXPECT_THAT(RecordFor(0, 21, 50000).items, ElementsAre(point, Item{ItemType::kByte, 1, 2}));
  EXPECT_THAT(RecordFor(6, 38, 50000).items, ElementsAre(point14, Item{ItemType::kByte14, 8, 3}));
}

TEST(LaszipRecord, IsReadAsItWasWritten) {
  for (int format = 0; format <= 10; ++format) {
    for (const std::uint32_t chunk_size : {1u, 50000u, kVariableChunks}) {
      const LaszipRecord record = RecordFor(format, 70, chunk_size);
      EXPECT_EQ(record.record_length(), 70u);
      const auto read = ParseLaszipRecord(LaszipRecordData(record), format, 70);
      EXPECT_EQ(read->compressor, record.compressor);
      EXPECT_EQ(read->chunk_size, chunk_size);
      EXPECT_EQ(read->items, record.items);
    }
  }
}

// A record that states `number` at `offset`, of point format 3 with 2 extra bytes.
template <typename Number>
absl::Status WithLie(std::size_t offset, Number number) {
  std::string data = LaszipRecordData(RecordFor(3, 36, 50000));
  Store(number, data.data() + offset);
  return ParseLaszipRecord(data, 3, 36).status();
}

void ExpectRefusal(const absl::Status& status, absl::StatusCode code, const std::string& problem) {
  EXPECT_EQ(status.code(), code) << status;
  EXPECT_THAT(std::string(status.message()), AllOf(HasSubstr("its LASzip record"), HasSubstr(problem)));
}

TEST(LaszipRecord, IsRefusedWithEachLie) {
  constexpr auto kInvalid = absl::StatusCode::kInvalidArgument, kUnimplemented = absl::StatusCode::kUnimplemented;
  ExpectRefusal(WithLie<std::uint16_t>(0, 0), kUnimplemented, "compressor 0 (expected 1, 2 or 3)");
  ExpectRefusal(WithLie<std::uint16_t>(0, 4), kUnimplemented, "compressor 4 (expected 1, 2 or 3)");
  ExpectRefusal(WithLie<std::uint16_t>(0, 3), kUnimplemented, "compressor 3 for point format 3 (expected 1 or 2)");
  ExpectRefusal(WithLie<std::uint16_t>(2, 1), kUnimplemented, "coder 1 (expected 0)");
  ExpectRefusal(WithLie<std::uint32_t>(12, 0), kInvalid, "chunks of 0 points (expected 1 or more)");
  ExpectRefusal(WithLie<std::uint16_t>(0, 1), kInvalid, "chunks of 50000 points (expected 0 for compressor 1)");
  ExpectRefusal(WithLie<std::uint16_t>(32, 3), kInvalid, "58 bytes (expected 52 for its 3 items)");
  ExpectRefusal(WithLie<std::uint16_t>(32, 0xFFFF), kInvalid, "58 bytes (expected 393244 for its 65535 items)");
  ExpectRefusal(WithLie<std::uint16_t>(34, 10), kInvalid, "items 10 of 20 bytes, 7 of 8 bytes");
  ExpectRefusal(WithLie<std::uint16_t>(36, 21), kInvalid, "expected 6 of 20 bytes, 7 of 8 bytes");
  ExpectRefusal(WithLie<std::uint16_t>(54, 3), kInvalid, "for point format 3 and records of 36 bytes");
  for (const std::size_t version : {38, 44, 50, 56}) {
    ExpectRefusal(WithLie<std::uint16_t>(version, 1), kUnimplemented, "version 1 of item");
    ExpectRefusal(WithLie<std::uint16_t>(version, 3), kUnimplemented, "version 3 of item");
  }
}

TEST(LaszipRecord, IsRefusedForAnotherFormatOrLength) {
  const std::string data = LaszipRecordData(RecordFor(3, 36, 50000));
  constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
  ExpectRefusal(ParseLaszipRecord(data, 1, 36).status(), kInvalid, "point format 1");
  ExpectRefusal(ParseLaszipRecord(data, 3, 34).status(), kInvalid, "records of 34 bytes");
  ExpectRefusal(ParseLaszipRecord(data, 3, 33).status(), kInvalid, "expected more bytes for point format 3");
  ExpectRefusal(ParseLaszipRecord(data, 7, 36).status(), absl::StatusCode::kUnimplemented,
                "compressor 2 for point format 7 (expected 3)");
}

constexpr std::size_t kChunkSize = 12, kItems = 34, kItemSize = 6;  // Offsets, and bytes of an item.

// All small numbers, and those beside powers of two.
std::set<std::uint16_t> TellingNumbers() {
  std::set<std::uint16_t> numbers;
  for (std::uint16_t i = 0; i < 300; ++i) numbers.insert(i);
  for (int bit = 8; bit < 16; ++bit)
    for (int by = -1; by <= 1; ++by) numbers.insert(static_cast<std::uint16_t>((1 << bit) + by));
  numbers.insert(0xFFFF);
  return numbers;
}

// Each field with each telling value. What is accepted does not change what is decoded.
class RecordLies : public ::testing::TestWithParam<int> {
 protected:
  std::size_t length_ = testing::PointSize(GetParam()) + 3;
  LaszipRecord truth_ = RecordFor(GetParam(), length_, kCommonChunkSize);
  std::string data_ = LaszipRecordData(truth_);

  void ExpectRefused(const std::string& data) {
    const absl::Status status = ParseLaszipRecord(data, GetParam(), length_).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status) || absl::IsUnimplemented(status)) << status;
    EXPECT_THAT(std::string(status.message()), StartsWith("its LASzip record "));
    EXPECT_THAT(std::string(status.message()),
                AnyOf(HasSubstr("; get another copy"), HasSubstr("; write the file again")));
  }

  // Whether numbers at this offset say how points are compressed.
  bool Matters(std::size_t offset) const { return offset < 4 || offset == 32 || offset >= kItems; }
  bool IsVersion(std::size_t offset) const { return offset >= kItems && (offset - kItems) % kItemSize == 4; }
  bool IsOfWavePacket(std::size_t offset) const {
    return truth_.items[(offset - kItems) / kItemSize].type == ItemType::kWavePacket14;
  }
};

TEST_P(RecordLies, OfAnyFieldAreRefusedOrChangeNothing) {
  for (std::size_t offset = 0; offset < data_.size(); offset += 2) {
    if (offset == kChunkSize || offset == kChunkSize + 2) continue;
    std::uint16_t truth;
    std::memcpy(&truth, data_.data() + offset, sizeof truth);
    for (const std::uint16_t number : TellingNumbers()) {
      SCOPED_TRACE(::testing::Message() << number << " at byte " << offset);
      std::string data = data_;
      std::memcpy(data.data() + offset, &number, sizeof number);
      const bool other_version =
          IsVersion(offset) && truth == 3 && (number == 4 || (number == 2 && !IsOfWavePacket(offset)));
      if (Matters(offset) && number != truth && !other_version) {
        ExpectRefused(data);
        continue;
      }
      const absl::StatusOr<LaszipRecord> record = ParseLaszipRecord(data, GetParam(), length_);
      EXPECT_EQ(record->compressor, truth_.compressor);
      EXPECT_EQ(record->chunk_size, truth_.chunk_size);
      EXPECT_EQ(record->items == truth_.items, !other_version);
    }
  }
}

TEST_P(RecordLies, ThatAreCutOrTooLongAreRefused) {
  for (std::size_t size = 0; size < data_.size(); ++size) ExpectRefused(data_.substr(0, size));
  ExpectRefused(data_ + '\0');
  ExpectRefused(data_ + data_.substr(kItems));
}

TEST_P(RecordLies, OfOtherPointsAreRefused) {
  for (int point_format = 0; point_format <= 10; ++point_format) {
    for (const std::size_t length : {std::size_t{0}, length_ - 1, length_, length_ + 1, std::size_t{0xFFFF}}) {
      if (point_format == GetParam() && length == length_) continue;
      SCOPED_TRACE(::testing::Message() << "point format " << point_format << ", " << length << " bytes");
      EXPECT_FALSE(ParseLaszipRecord(data_, point_format, length).ok());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, RecordLies, ::testing::Range(0, 11),
                         [](const auto& point_format) { return "Format" + std::to_string(point_format.param); });

}  // namespace
}  // namespace albtpu::laz
