#include "formats/las/las_extra_bytes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <iterator>

#include "laz/coding/little_endian.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::ExtraBytesEntry;
using laz::Load;
using ::testing::HasSubstr;

std::string Describe(const std::string& described, std::size_t extra_bytes) {
  const auto record = DescribeAppended("in.las", described, extra_bytes, AppendedFloats({}));
  return record.ok() ? record->record : std::string(record.status().message());
}

std::string NameOf(const std::string& record, std::size_t entry) { return record.substr(192 * entry + 4, 32).c_str(); }
int TypeOf(const std::string& record, std::size_t entry) { return Load<std::uint8_t>(record, 192 * entry + 2); }
int OptionsOf(const std::string& record, std::size_t entry) { return Load<std::uint8_t>(record, 192 * entry + 3); }

TEST(LasExtraBytes, DescribesTwoFloatsAndTheirNoDataValue) {
  const std::string record = Describe("", 0);
  ASSERT_EQ(record.size(), 2 * 192u);
  EXPECT_EQ(NameOf(record, 0), "sea_thu");
  EXPECT_EQ(NameOf(record, 1), "sea_tvu");
  for (const std::size_t entry : {0, 1}) {
    EXPECT_EQ(TypeOf(record, entry), 9);     // float
    EXPECT_EQ(OptionsOf(record, entry), 1);  // Only no-data is set.
    EXPECT_EQ(Load<double>(record, 192 * entry + 40), -1.0);
    EXPECT_STREQ(record.substr(192 * entry + 160, 32).c_str(), "sea surface only, 2 sigma, m");
  }
}

TEST(LasExtraBytes, StatesTheCoverage) {
  const auto record = DescribeAppended("in.las", "", 0, AppendedFloats({.coverage = Coverage::kP95, .details = false}));
  EXPECT_STREQ(record->record.substr(160, 32).c_str(), "sea surface only, 95 %, m");
}

TEST(LasExtraBytes, DescribesTheGeometryOfBeamsOnRequest) {
  const auto record = DescribeAppended("in.las", "", 0, AppendedFloats({.details = true}));
  ASSERT_EQ(record->record.size(), AppendedFloats({.details = true}).size() * 192);
  const struct {
    const char* name;
    bool is_angle;
  } expected[] = {{"incidence", true},
                  {"beam_azimuth", true},
                  {"footprint", false},
                  {"water_depth", false},
                  {"slant_range", false}};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(NameOf(record->record, 2 + i), expected[i].name);
    EXPECT_EQ(TypeOf(record->record, 2 + i), 9);
    EXPECT_EQ(OptionsOf(record->record, 2 + i), 1);
    const auto no_data = Load<double>(record->record, 192 * (2 + i) + 40);
    EXPECT_TRUE(expected[i].is_angle ? std::isnan(no_data) : no_data == -1) << expected[i].name;
  }
}

TEST(LasExtraBytes, DescribesUndocumentedBytesFirst) {
  const std::string record = Describe("", 6);
  ASSERT_EQ(record.size(), 3 * 192u);
  EXPECT_EQ(NameOf(record, 0), "undocumented");
  EXPECT_EQ(TypeOf(record, 0), 0);
  EXPECT_EQ(OptionsOf(record, 0), 6);
  EXPECT_EQ(NameOf(record, 1), "sea_thu");
}

TEST(LasExtraBytes, SplitsManyUndocumentedBytes) {
  const std::string record = Describe("", 600);
  ASSERT_EQ(record.size(), 5 * 192u);
  EXPECT_EQ(OptionsOf(record, 0) + OptionsOf(record, 1) + OptionsOf(record, 2), 600);
  EXPECT_EQ(NameOf(record, 2), "undocumented_3");
}

TEST(LasExtraBytes, KeepsExistingDescriptionsAndAddsTheMissingOnes) {
  const std::string described = ExtraBytesEntry(4, 0, "echo width") + ExtraBytesEntry(0, 5, "undocumented");
  const std::string record = Describe(described, 2 + 5 + 7);
  ASSERT_EQ(record.size(), 5 * 192u);
  EXPECT_EQ(record.substr(0, described.size()), described);
  EXPECT_EQ(NameOf(record, 2), "undocumented_2");
  EXPECT_EQ(OptionsOf(record, 2), 7);
}

TEST(LasExtraBytes, KnowsTheSizeOfEveryType) {
  const int sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  for (int type = 1; type <= 30; ++type) {
    const int size = sizes[(type - 1) % 10] * ((type - 1) / 10 + 1);
    const std::string described = ExtraBytesEntry(static_cast<std::uint8_t>(type), 0, "x");
    EXPECT_EQ(Describe(described, size).size(), 3 * 192u) << type;  // No undocumented bytes remain.
    EXPECT_THAT(Describe(described, size - 1), HasSubstr("extra bytes, but its points have")) << type;
  }
}

TEST(LasExtraBytes, RejectsNamesThatExistAlready) {
  EXPECT_THAT(Describe(ExtraBytesEntry(9, 0, "sea_tvu"), 4), HasSubstr("in.las: already has sea_tvu"));
  EXPECT_THAT(Describe(ExtraBytesEntry(9, 0, "sea_tvu"), 4), HasSubstr("--replace"));
}

TEST(LasExtraBytes, ReplacesFloatsAndDoublesOfTheSameNames) {
  const std::string described =
      ExtraBytesEntry(4, 0, "echo width") + ExtraBytesEntry(10, 24, "sea_tvu") + ExtraBytesEntry(1, 0, "x");
  const auto ours = DescribeAppended("in.las", described, 2 + 8 + 1, AppendedFloats({}), true);
  ASSERT_EQ(ours->record.size(), 4 * 192u);  // Only sea_thu is new.
  EXPECT_EQ(NameOf(ours->record, 1), "sea_tvu");
  EXPECT_EQ(TypeOf(ours->record, 1), 10);
  EXPECT_EQ(OptionsOf(ours->record, 1), 1);  // Its scale and offset are gone.
  EXPECT_EQ(NameOf(ours->record, 3), "sea_thu");
  ASSERT_EQ(ours->replaced.size(), 1u);
  EXPECT_EQ(ours->replaced[0].appended, 1u);
  EXPECT_EQ(ours->replaced[0].offset, 2u);
  EXPECT_TRUE(ours->replaced[0].is_double);
}

TEST(LasExtraBytes, ReplacesNothingThatHoldsNoNumberOfOurs) {
  const auto replace = [](const std::string& described, std::size_t bytes) {
    return std::string(DescribeAppended("in.las", described, bytes, AppendedFloats({}), true).status().message());
  };
  EXPECT_THAT(replace(ExtraBytesEntry(3, 0, "sea_thu"), 2), HasSubstr("has sea_thu as type 3"));
  EXPECT_THAT(replace(ExtraBytesEntry(9, 0, "sea_thu") + ExtraBytesEntry(9, 0, "sea_thu"), 8),
              HasSubstr("describes sea_thu twice"));
}

TEST(LasExtraBytes, RejectsInvalidRecords) {
  EXPECT_THAT(Describe("short", 4), HasSubstr("a multiple of 192"));
  EXPECT_THAT(Describe(ExtraBytesEntry(31, 0, "x"), 4), HasSubstr("type 31"));
  std::string full;
  for (int i = 0; i < 340; ++i) full += ExtraBytesEntry(1, 0, std::to_string(i));
  EXPECT_THAT(Describe(full, 340), HasSubstr("2 more descriptions exceed 65535 bytes"));
}

}  // namespace
}  // namespace albtpu::formats
