#include "formats/las/las_header.h"

#include <gmock/gmock.h>

#include <limits>

#include "laz/coding/little_endian.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::LasSpec;
using laz::Store;
using ::testing::HasSubstr;

LasSpec Spec(int version_minor = 4, int point_format = 6) {
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  spec.points.resize(10);
  spec.extra_bytes = 3;
  return spec;
}

absl::StatusOr<LasHeader> Parse(const std::string& file) { return ParseLasHeader("in.las", file, file.size()); }

std::string ErrorOf(const std::string& file) { return std::string(Parse(file).status().message()); }

// The file with the number in one field replaced.
template <typename Number>
std::string With(std::string file, std::size_t field, Number number) {
  Store(number, file.data() + field);
  return file;
}

TEST(LasHeader, ReadsEveryVersionAndFormat) {
  for (int version = 0; version <= 5; ++version) {
    for (int format = version == 5 ? 6 : 0; format <= (version < 2    ? 1
                                                       : version == 2 ? 3
                                                       : version == 3 ? 5
                                                                      : 10);
         ++format) {
      const LasSpec spec = Spec(version, format);
      const absl::StatusOr<LasHeader> header = Parse(BuildLas(spec));
      EXPECT_EQ(header->version_minor, version);
      EXPECT_EQ(header->point_format, format);
      EXPECT_EQ(header->point_count, 10u);
      EXPECT_EQ(header->extra_bytes(), 3u);
      EXPECT_EQ(header->scale, (std::array{0.001, 0.001, 0.001}));
      EXPECT_FALSE(header->adjusted_gps_time);
      EXPECT_EQ(MinimumRecordLength(format), albtpu::testing::PointSize(format));
    }
  }
}

TEST(LasHeader, RejectsOtherFiles) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("in.las: is not a LAS file"));
  EXPECT_THAT(ErrorOf("PK\3\4 something else"), HasSubstr("is not a LAS file"));
}

TEST(LasHeader, RejectsOtherVersions) {
  EXPECT_THAT(ErrorOf(With<std::uint8_t>(BuildLas(Spec()), las_field::kVersionMinor, 6)), HasSubstr("is LAS 1.6"));
  EXPECT_THAT(ErrorOf(With<std::uint8_t>(BuildLas(Spec()), las_field::kVersionMajor, 2)), HasSubstr("is LAS 2.4"));
}

TEST(LasHeader, TakesThePointsOfLazForCompressed) {
  std::string file = With<std::uint8_t>(BuildLas(Spec()), las_field::kPointFormat, 0x80 | 6);
  // More points than bytes.
  file = With<std::uint64_t>(file, las_field::kPointCount, 1'000'000'000'000);
  const absl::StatusOr<LasHeader> header = Parse(file);
  EXPECT_TRUE(header->compressed);
  EXPECT_EQ(header->point_format, 6);
  EXPECT_EQ(header->point_count, 1'000'000'000'000u);
  EXPECT_FALSE(Parse(BuildLas(Spec()))->compressed);
}

TEST(LasHeader, SuggestsADecompressorForTheFirstLaszip) {
  for (const int bits : {0x40, 0xC0}) {
    EXPECT_THAT(
        ErrorOf(With<std::uint8_t>(BuildLas(Spec()), las_field::kPointFormat, static_cast<std::uint8_t>(6 | bits))),
        HasSubstr("from before 2.0 (2011); decompress it first, by `laszip -i"));
  }
}

TEST(LasHeader, RejectsPointFormatsThatTheVersionDoesNotDefine) {
  EXPECT_THAT(ErrorOf(With<std::uint8_t>(BuildLas(Spec(2, 3)), las_field::kPointFormat, 4)),
              HasSubstr("point format 4 in LAS 1.2; expected 0 to 3"));
  EXPECT_THAT(ErrorOf(With<std::uint8_t>(BuildLas(Spec(4, 10)), las_field::kPointFormat, 11)),
              HasSubstr("expected 0 to 10"));
}

TEST(LasHeader, DetectsTruncationAtEveryLength) {
  const std::string file = BuildLas(Spec());
  for (std::size_t size = 4; size < file.size(); ++size)
    ASSERT_EQ(Parse(file.substr(0, size)).status().code(), absl::StatusCode::kDataLoss) << size;
}

TEST(LasHeader, RejectsPointCountsThatDisagreeWithTheFile) {
  const std::string file = BuildLas(Spec());
  EXPECT_THAT(ErrorOf(With<std::uint64_t>(file, las_field::kPointCount, 11)),
              HasSubstr("states 11 points, but the file has 10"));
  // So many points that the number of their bytes overflows 64 bits.
  EXPECT_THAT(ErrorOf(With(file, las_field::kPointCount, std::numeric_limits<std::uint64_t>::max())),
              HasSubstr("the file has 10"));
  EXPECT_THAT(ErrorOf(With<std::uint64_t>(file, las_field::kPointCount, 8)),
              HasSubstr("states 8 points, but 66 bytes, enough for 2 more"));
  EXPECT_THAT(ErrorOf(With<std::uint32_t>(file, las_field::kLegacyPointCount, 9)),
              HasSubstr("states 10 points, but 9 in the legacy field"));
  EXPECT_THAT(ErrorOf(With<std::uint32_t>(BuildLas(Spec(2, 1)), las_field::kLegacyPointCount, 11)),
              HasSubstr("states 11 points"));
}

TEST(LasHeader, RejectsOverlappingOffsets) {
  const std::string file = BuildLas(Spec());
  EXPECT_THAT(ErrorOf(With<std::uint16_t>(file, las_field::kHeaderSize, 227)), HasSubstr("header size 227"));
  EXPECT_THAT(ErrorOf(With<std::uint32_t>(file, las_field::kOffsetToPoints, 100)),
              HasSubstr("begin at byte 100, inside the header"));
  EXPECT_THAT(ErrorOf(With<std::uint32_t>(file, las_field::kOffsetToPoints, 0xFFFFFFFF)),
              HasSubstr("begin at byte 4294967295"));
  EXPECT_THAT(ErrorOf(With<std::uint16_t>(file, las_field::kRecordLength, 29)),
              HasSubstr("records of 29 bytes; point format 6 needs 30 or more"));
  EXPECT_THAT(ErrorOf(With<std::uint16_t>(file, las_field::kRecordLength, 0)), HasSubstr("records of 0 bytes"));
}

TEST(LasHeader, FindsWaveformsWhoseBitIsNotSet) {
  for (const auto& [version, format] : {std::pair(3, 4), std::pair(4, 9)}) {
    LasSpec spec = Spec(version, format);
    spec.waveform_packet = "waveforms longer than a record of points, of 60 bytes and the extra bytes behind them";
    const std::string file = BuildLas(spec);
    const std::uint64_t start = Parse(file)->start_of_waveform_packet;
    ASSERT_GT(start, 0u);
    const auto encoding = laz::Load<std::uint16_t>(file, las_field::kGlobalEncoding);
    const auto without = static_cast<std::uint16_t>(encoding & ~0x2);
    EXPECT_EQ(Parse(With(file, las_field::kGlobalEncoding, without))->start_of_waveform_packet, start);
    // In another file the number means nothing in this one.
    const std::string outside = With(file, las_field::kGlobalEncoding, static_cast<std::uint16_t>(without | 0x4));
    EXPECT_THAT(ErrorOf(outside), HasSubstr("more points, follow them"));
  }
}

TEST(LasHeader, RejectsEvlrsThatAreNotAfterThePoints) {
  LasSpec spec = Spec();
  spec.evlrs.push_back({"someone", 1, "data"});
  const std::string file = BuildLas(spec);
  ASSERT_TRUE(Parse(file).ok());
  EXPECT_THAT(ErrorOf(With<std::uint64_t>(file, las_field::kStartOfEvlrs, 400)), HasSubstr("begin at byte 400"));
  EXPECT_THAT(ErrorOf(With<std::uint64_t>(file, las_field::kStartOfEvlrs, file.size() + 1)),
              HasSubstr("extended variable length records begin at byte"));
  EXPECT_THAT(ErrorOf(With<std::uint64_t>(file, las_field::kStartOfEvlrs, 0)), HasSubstr("but not where they begin"));
}

TEST(LasHeader, RejectsScalesAndOffsetsThatAreNotFinite) {
  const std::string file = BuildLas(Spec());
  EXPECT_THAT(ErrorOf(With(file, las_field::kScale, 0.0)), HasSubstr("x scale 0"));
  EXPECT_THAT(ErrorOf(With(file, las_field::kScale + 16, 0.0)), HasSubstr("z scale 0"));
  EXPECT_THAT(ErrorOf(With(file, las_field::kOffset + 8, std::numeric_limits<double>::quiet_NaN())),
              HasSubstr("y scale 0.001 and offset nan"));
}

TEST(LasHeader, ReadsTheBoundsAndTheFormOfTimes) {
  LasSpec spec = Spec(4, 6);
  spec.points[3] = {-5000, 20, 7, 40, 0};
  std::string file = BuildLas(spec);
  file[las_field::kGlobalEncoding] |= 1;
  const absl::StatusOr<LasHeader> header = Parse(file);
  EXPECT_EQ(header->least, (std::array{-5.0, 0.0, 0.0}));
  EXPECT_EQ(header->greatest, (std::array{0.0, 0.02, 0.007}));
  EXPECT_TRUE(header->adjusted_gps_time);
}

TEST(LasHeader, IgnoresTheReservedBytesOfTheFirstVersions) {
  for (const int version : {0, 1}) {
    std::string file = BuildLas(Spec(version, 1));
    file[las_field::kGlobalEncoding] |= 1;
    EXPECT_FALSE(Parse(file)->adjusted_gps_time);
  }
}

}  // namespace
}  // namespace albtpu::formats
