#include "formats/las/las_points.h"

#include <gtest/gtest.h>

#include "tests/formats/las/las_builder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::LasSpec;

TEST(LasPoints, HaveTheSameFieldsInEveryFormat) {
  for (int format = 0; format <= kLargestPointFormat; ++format) {
    LasSpec spec;
    spec.point_format = format;
    spec.scale = 0.25;  // Exact in binary.
    spec.points = {{.x = -3,
                    .y = 5,
                    .z = -7,
                    .classification = 26,
                    .scan_angle = -12,
                    .gps_time = 1.5e8 + 0.25,
                    .return_number = 2,
                    .return_count = 5}};
    const std::string file = BuildLas(spec);
    const absl::StatusOr<LasHeader> header = ParseLasHeader("in.las", file, file.size());
    const LasPointFields fields(*header);
    const std::string_view record = std::string_view(file).substr(header->offset_to_points);
    EXPECT_EQ(fields.X(record), -0.75);
    EXPECT_EQ(fields.Y(record), 1.25);
    EXPECT_EQ(fields.Z(record), -1.75);
    EXPECT_EQ(fields.Class(record), 26);
    EXPECT_DOUBLE_EQ(fields.ScanAngle(record), -12);
    EXPECT_EQ(fields.ReturnNumber(record), 2);
    EXPECT_EQ(fields.ReturnCount(record), 5);
    EXPECT_EQ(fields.ScannerChannel(record), 0);
    EXPECT_EQ(fields.has_gps_time(), format != 0 && format != 2);
    if (!fields.has_gps_time()) continue;
    EXPECT_EQ(fields.GpsTime(record), 1.5e8 + 0.25);
  }
}

TEST(LasPoints, OfFormatsFrom6HaveAChannel) {
  LasSpec spec;
  spec.points.resize(1);
  std::string file = BuildLas(spec);
  const absl::StatusOr<LasHeader> header = ParseLasHeader("in.las", file, file.size());
  std::string record = file.substr(header->offset_to_points);
  record[15] = static_cast<char>(0xEF);  // Bits 4 and 5; the others are flags.
  EXPECT_EQ(LasPointFields(*header).ScannerChannel(record), 2);
}

}  // namespace
}  // namespace albtpu::formats
