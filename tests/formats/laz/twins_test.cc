// LAZ files that other programs wrote, against the same points uncompressed. The files may lie beside the checkout.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "formats/laz/coding/little_endian.h"
#include "tests/formats/laz/laz_bytes.h"
#include "tests/formats/laz/laz_sample.h"

namespace albtpu::testing {
namespace {

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
  }

  std::string file_;
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
