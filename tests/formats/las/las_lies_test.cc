// Files whose header or records contradict the points, each of which is read right or refused by one message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "formats/las/las_points.h"
#include "formats/las/las_reader.h"
#include "laz/coding/little_endian.h"
#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::ExtraBytesEntry;
using albtpu::testing::LasRecord;
using albtpu::testing::LasSpec;
using albtpu::testing::TemporaryFolder;
using laz::Store;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kGpsTime = 1'447'532'420.25;  // GPS seconds, in November 2025.

LasSpec SpecOfTwoPoints(int version_minor, int point_format) {
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  spec.points = {{.x = 1, .y = 2, .z = -3000, .classification = 26}, {.x = 4, .y = 5, .z = -6000}};
  return spec;
}

class LasLies : public ::testing::Test {
 protected:
  absl::StatusOr<LasReader> Open(const std::string& file) { return LasReader::Open(folder_.Write("in.las", file)); }
  std::string ErrorOf(const std::string& file) { return std::string(Open(file).status().message()); }

  TemporaryFolder folder_;
};

struct Lie {
  const char* name;
  std::function<void(std::string&)> tell;
  const char *problem, *remedy;
};

template <typename Number>
std::function<void(std::string&)> Put(std::size_t field, Number number) {
  return [=](std::string& file) { Store(number, file.data() + field); };
}

TEST_F(LasLies, OfNumbersAreRefused) {
  const std::vector<Lie> lies = {
      {"legacy count", Put<std::uint32_t>(las_field::kLegacyPointCount, 1), "states 2 points, but 1 in the legacy", ""},
      {"only a legacy count",
       [](std::string& file) {
         Put<std::uint64_t>(las_field::kPointCount, 0)(file);
         Put<std::uint32_t>(las_field::kLegacyPointCount, 2)(file);
       },
       "states 0 points, but 2 in the legacy", ""},
      {"no points", Put<std::uint64_t>(las_field::kPointCount, 0), "states 0 points, but 60 bytes",
       "correct the point"},
      {"a tiny scale", Put(las_field::kScale + 16, 1e-300), "has z scale 1e-300", "from 1e-12 to 10"},
      {"a huge scale", Put(las_field::kScale, 1000.0), "has x scale 1000", "correct the header"},
      {"a scale that is none", Put(las_field::kScale + 8, std::numeric_limits<double>::quiet_NaN()), "has y scale nan",
       "correct the header"},
      {"a denormal scale", Put(las_field::kScale, std::numeric_limits<double>::denorm_min()), "has x scale 4.9",
       "correct the header"},
      {"an infinite scale", Put(las_field::kScale, -std::numeric_limits<double>::infinity()), "has x scale -inf",
       "correct the header"},
      {"a huge offset", Put(las_field::kOffset + 16, -1e300), "and offset -1e+300", "at most 1e+11"},
      {"no records", Put<std::uint32_t>(las_field::kVlrCount, 0), "counts 0 variable length records, but another",
       "correct the number"},
      {"too few records", Put<std::uint32_t>(las_field::kVlrCount, 1), "(LASF_Projection 2112)", "correct the number"},
      {"too many records", Put<std::uint32_t>(las_field::kVlrCount, 3), "does not end before the points", "correct"},
      {"no extended records", Put<std::uint32_t>(las_field::kEvlrCount, 0), "", "correct"},
      {"too few extended records", Put<std::uint32_t>(las_field::kEvlrCount, 1), "counts 1 extended", "(LASF_Spec 7)"},
      {"a flag of LAS 1.5", Put<std::uint16_t>(las_field::kGlobalEncoding, 0x51), "time offset flag", "correct the"},
      {"a later version", Put<std::uint8_t>(las_field::kVersionMinor, 5), "has header size 375", "393 bytes"},
      {"an earlier version", Put<std::uint8_t>(las_field::kVersionMinor, 3), "has point format 6 in LAS 1.3", "0 to 5"},
  };
  LasSpec spec = SpecOfTwoPoints(4, 6);
  spec.vlrs = {{"LASF_Spec", 3, "a text"}, {"LASF_Projection", 2112, albtpu::testing::kMetricWkt}};
  spec.evlrs = {{"LASF_Spec", 7, "a text"}, {"LASF_Spec", 7, "a text"}};
  const std::string right = BuildLas(spec);
  ASSERT_TRUE(Open(right).ok());
  for (const Lie& lie : lies) {
    std::string file = right;
    lie.tell(file);
    EXPECT_THAT(ErrorOf(file),
                AllOf(StartsWith((folder_ / "in.las").string() + ": "), HasSubstr(lie.problem), HasSubstr(lie.remedy)))
        << lie.name;
  }
}

// A box is never believed, and bytes between records that are none of the specification's are kept.
TEST_F(LasLies, ThatDoNotMatterAreRead) {
  LasSpec spec = SpecOfTwoPoints(4, 6);
  spec.gap = std::string(100, 'x');
  for (const auto& tell : {Put(las_field::kBounds, 0.0), Put(las_field::kBounds + 8, 1e300),
                           Put(las_field::kBounds + 32, std::numeric_limits<double>::quiet_NaN()),
                           Put<std::uint64_t>(255, 77), Put<std::uint16_t>(92, 0)}) {
    std::string file = BuildLas(spec);
    tell(file);
    EXPECT_TRUE(Open(file).ok());
  }
}

struct Clock {
  bool adjusted;
  std::optional<std::uint16_t> offset;
  double stored, read;  // s; read as GPS time - 1e9 s, or as seconds of the week.
};

TEST_F(LasLies, TimesOfLas15AreThoseOfLas14) {
  for (const Clock& clock : {Clock{true, 1400, kGpsTime - 1400e6, kGpsTime - 1e9},
                             {true, 1500, kGpsTime - 1500e6, kGpsTime - 1e9},
                             {true, 1000, kGpsTime - 1e9, kGpsTime - 1e9},
                             {true, 0, kGpsTime, kGpsTime - 1e9},
                             {true, 65535, kGpsTime - 65535e6, kGpsTime - 1e9},
                             {true, std::nullopt, kGpsTime - 1e9, kGpsTime - 1e9},
                             {false, std::nullopt, 224'420.25, 224'420.25},
                             {true, 1400, 0, 0}}) {
    for (const int format : {6, 7, 8, 9, 10}) {
      LasSpec spec = SpecOfTwoPoints(5, format);
      spec.adjusted_time = clock.adjusted;
      spec.time_offset = clock.offset;
      spec.points[0].gps_time = clock.stored;
      const absl::StatusOr<LasReader> reader = Open(BuildLas(spec));
      ASSERT_TRUE(reader.ok()) << reader.status();
      EXPECT_EQ(reader->header().version_minor, 5);
      EXPECT_EQ(reader->header().adjusted_gps_time, clock.adjusted);
      const LasPointFields fields(reader->header());
      EXPECT_NEAR(fields.GpsTime(*FirstRecord(*reader)), clock.read, 1e-5);  // 65535e6 has steps of 8e-6 s.
    }
  }
}

TEST_F(LasLies, OfTimesOfLas15AreRefused) {
  LasSpec spec = SpecOfTwoPoints(5, 6);
  spec.adjusted_time = true;
  spec.time_offset = 1400;
  const std::string right = BuildLas(spec);
  ASSERT_TRUE(Open(right).ok());
  const std::vector<Lie> lies = {
      {"no flag", Put<std::uint16_t>(las_field::kGlobalEncoding, 0x11), "states a time offset of 1.4e+09 s", "set the"},
      {"week and offset", Put<std::uint16_t>(las_field::kGlobalEncoding, 0x10), "states a time offset", "set the flag"},
      {"offset alone", Put<std::uint16_t>(las_field::kGlobalEncoding, 0x50), "without that of standard", "set both"},
      {"an old format", Put<std::uint8_t>(las_field::kPointFormat, 3), "has point format 3 in LAS 1.5", "6 to 10"},
      {"a short header", Put<std::uint16_t>(las_field::kHeaderSize, 375), "has header size 375", "393 bytes"},
      {"LAS 1.6", Put<std::uint8_t>(las_field::kVersionMinor, 6), "is LAS 1.6 (expected 1.0 to 1.5)", "convert it"},
      {"LAS 1.4", Put<std::uint8_t>(las_field::kVersionMinor, 4), "time offset flag of LAS 1.5", "correct the version"},
  };
  for (const Lie& lie : lies) {
    std::string file = right;
    lie.tell(file);
    EXPECT_THAT(ErrorOf(file), AllOf(HasSubstr(lie.problem), HasSubstr(lie.remedy))) << lie.name;
  }
  // An offset of 1000 is that of adjusted standard GPS time, with the flag or without it.
  std::string file = right;
  Store<std::uint16_t>(1000, file.data() + las_field::kTimeOffset);
  Store<std::uint16_t>(0x11, file.data() + las_field::kGlobalEncoding);
  EXPECT_EQ(Open(file)->header().time_shift, 0);
}

TEST_F(LasLies, PointsOfLas14InTheFormOfOlderFormatsAreNamed) {
  const LasRecord mode = {"lascompatible", 22204, std::string(156, '\0')};
  std::string extra;
  for (const auto& [type, name] : {std::pair{4, "LAS 1.4 scan angle"},
                                   {1, "LAS 1.4 extended returns"},
                                   {1, "LAS 1.4 classification"},
                                   {1, "LAS 1.4 flags and channel"}})
    extra += ExtraBytesEntry(static_cast<std::uint8_t>(type), 0, name);
  const LasRecord described = {"LASF_Spec", 4, extra};
  for (const int format : {1, 3, 4, 5}) {
    for (const std::vector<LasRecord>& records :
         {std::vector{mode, described}, {described, mode}, {mode}, {described}}) {
      LasSpec spec = SpecOfTwoPoints(format > 3 ? 3 : 2, format);
      spec.extra_bytes = 5;
      spec.vlrs = records;
      EXPECT_THAT(ErrorOf(BuildLas(spec)), AllOf(HasSubstr("compatibility mode of LASzip (lascompatible)"),
                                                 HasSubstr("laszip -i IN.laz -o OUT.las")));
    }
  }
  // The record is of no importance where the points have a format of LAS 1.4.
  LasSpec spec = SpecOfTwoPoints(4, 6);
  spec.extra_bytes = 5;
  spec.vlrs = {mode, described};
  EXPECT_TRUE(Open(BuildLas(spec)).ok());
}

TEST_F(LasLies, WithheldIsAFlagOfEveryFormat) {
  for (int format = 0; format <= kLargestPointFormat; ++format) {
    LasSpec spec = SpecOfTwoPoints(4, format);
    const std::size_t size = albtpu::testing::PointSize(format);
    spec.points[1].withheld = true;
    const absl::StatusOr<LasReader> reader = Open(BuildLas(spec));
    const std::string records = *reader->ReadAt(reader->header().offset_to_points, 2 * size);
    const LasPointFields fields(reader->header());
    EXPECT_FALSE(fields.IsWithheld(std::string_view(records).substr(0, size)));
    EXPECT_TRUE(fields.IsWithheld(std::string_view(records).substr(size)));
    EXPECT_EQ(fields.Class(records), 26);
  }
}

}  // namespace
}  // namespace albtpu::formats
