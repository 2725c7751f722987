// LASzip records that lie: each field with each telling value. What is accepted does not change what is decoded.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <string>

#include "formats/laz/items/laszip_record.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::laz {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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

TEST_P(RecordLies, OfChunksWithoutPointsAreRefused) {
  std::memset(data_.data() + kChunkSize, 0, 4);
  ExpectRefused(data_);
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
