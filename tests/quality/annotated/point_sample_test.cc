#include "quality/annotated/point_sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/formats/las/las_builder.h"

namespace albtpu::quality {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::LasPoint;
using albtpu::testing::LasSpec;

// A line over the same bottom as that of every other seed, by two returns of each pulse.
LasSpec Line(int seed, int pulses = 20000) {
  std::mt19937_64 random(seed);
  LasSpec line;
  for (int i = 0; i < pulses; ++i)
    for (int of_pulse = 1; of_pulse <= 2; ++of_pulse)
      line.points.push_back({.x = static_cast<int>(random() % 100'000),
                             .y = static_cast<int>(random() % 100'000),
                             .classification = 39 + of_pulse,
                             .gps_time = 1000.0 * seed + i / 20000.0,
                             .return_number = of_pulse,
                             .return_count = 2});
  return line;
}

std::shared_ptr<const PointSample> SampleOf(const LasSpec& spec) {
  const std::string file = BuildLas(spec);
  const absl::StatusOr<formats::LasHeader> header = formats::ParseLasHeader("in.las", file, file.size());
  auto sample = std::make_shared<PointSample>(*header, false);
  const std::string_view records = std::string_view(file).substr(header->offset_to_points);
  for (std::size_t at = 0; at < records.size(); at += 1000 * header->record_length)
    sample->Add(sample->Choose(records.substr(at, 1000 * header->record_length)));
  return sample;
}

double Common(const LasSpec& a, const LasSpec& b) { return PointSample::CommonOf(*SampleOf(a), *SampleOf(b)).share; }

TEST(PointSample, OfACopyIsTheSameWhateverItsOrderClassesHeightsAndFormatAre) {
  const LasSpec line = Line(1);
  LasSpec copy = line;
  EXPECT_EQ(Common(line, copy), 1);
  std::shuffle(copy.points.begin(), copy.points.end(), std::mt19937_64(7));
  for (LasPoint& point : copy.points) {
    point.z += 150;
    point.classification = 2;
    point.gps_time += 2e-8;  // Rounded.
  }
  copy.version_minor = 2;
  copy.point_format = 1;
  copy.extra_bytes = 30;
  EXPECT_GT(Common(line, copy), 0.99);
  EXPECT_GT(Common(copy, line), 0.99);
}

TEST(PointSample, OfCoordinatesThatWereRoundedIsTheSame) {
  const LasSpec line = Line(1);
  LasSpec rounded = line;
  rounded.scale = 0.01;
  for (LasPoint& point : rounded.points) point.x = (point.x + 5) / 10, point.y = (point.y + 5) / 10;
  EXPECT_EQ(Common(line, rounded), 1);
}

TEST(PointSample, OfAPartOfAFileHasPointsInCommonWithIt) {
  const LasSpec line = Line(1);
  LasSpec part = line;
  std::erase_if(part.points, [](const LasPoint& point) { return point.classification == 41 || point.x > 70'000; });
  EXPECT_EQ(Common(line, part), 1);
  EXPECT_EQ(Common(part, line), 1);
}

TEST(PointSample, OfAnotherLineHasNoneInCommon) {
  EXPECT_EQ(Common(Line(1), Line(2)), 0);
  // Nor has that of another receiver of the same pulses.
  LasSpec receiver = Line(2);
  for (LasPoint& point : receiver.points) point.gps_time -= 1000;
  EXPECT_EQ(Common(Line(1), receiver), 0);
}

TEST(PointSample, OfPointsWithoutTimesIsChosenByTheirPlaces) {
  const auto without = [](int seed) {
    LasSpec line = Line(seed);
    for (LasPoint& point : line.points) point.gps_time = 0;
    return line;
  };
  EXPECT_EQ(Common(without(1), without(1)), 1);
  EXPECT_LT(Common(without(1), without(2)), 0.01);
}

TEST(PointSample, IsNotJudgedByFewPointsOrByOneTime) {
  EXPECT_EQ(Common(Line(1, 3), Line(1, 3)), 0);
  LasSpec frozen = Line(1);
  for (LasPoint& point : frozen.points) point.gps_time = 5;
  EXPECT_EQ(Common(frozen, frozen), 0);
}

TEST(SampledFiles, NameTheFileWhosePointsAreThoseOfAnother) {
  SampledFiles files;
  EXPECT_TRUE(files.Add("a.las", SampleOf(Line(1))).ok());
  EXPECT_TRUE(files.Add("b.las", SampleOf(Line(2))).ok());
  EXPECT_TRUE(files.Add("a.las", SampleOf(Line(1))).ok());  // Read again.
  EXPECT_EQ(files.Add("c.laz", SampleOf(Line(2))).message(),
            "c.laz: has points of b.las, at the same times and places: 100 % of those of the smaller file, which would "
            "count twice; give one of the two files");
}

// Parts of one line, to x and from x [mm].
std::pair<LasSpec, LasSpec> Tiles(int to, int from) {
  LasSpec west = Line(1), east = west;
  std::erase_if(west.points, [&](const LasPoint& point) { return point.x > to; });
  std::erase_if(east.points, [&](const LasPoint& point) { return point.x < from; });
  return {west, east};
}

TEST(SampledFiles, NameTilesWithBuffers) {
  const auto [west, east] = Tiles(55'000, 45'000);
  SampledFiles files;
  EXPECT_TRUE(files.Add("west.las", SampleOf(west)).ok());
  const std::string message(files.Add("east.las", SampleOf(east)).message());
  EXPECT_THAT(message, ::testing::HasSubstr("east.las: has points of west.las"));
  EXPECT_THAT(message, ::testing::HasSubstr("where these are tiles with buffers, remove the points of the buffers"));
}

TEST(SampledFiles, TakeTilesThatHaveAnEdgeInCommon) {
  const auto [west, east] = Tiles(50'050, 49'950);
  SampledFiles files;
  EXPECT_TRUE(files.Add("west.las", SampleOf(west)).ok());
  EXPECT_TRUE(files.Add("east.las", SampleOf(east)).ok());
}

TEST(SampledFiles, TakeTilesWhoseBuffersAreWithheld) {
  auto [west, east] = Tiles(55'000, 45'000);
  for (LasPoint& point : east.points) point.withheld = point.x <= 55'000;
  SampledFiles files;
  EXPECT_TRUE(files.Add("west.las", SampleOf(west)).ok());
  EXPECT_TRUE(files.Add("east.las", SampleOf(east)).ok());
}

// Two receivers of the same pulses have the same times and places of some points, at heights of their own.
TEST(SampledFiles, TakeAFewPointsOfTheSameTimesAndPlacesAtOtherHeights) {
  LasSpec other = Line(2);
  const LasSpec line = Line(1);
  for (std::size_t i = 0; i < line.points.size(); i += 10) {
    other.points[i] = line.points[i];
    other.points[i].z += 50;
  }
  SampledFiles files;
  EXPECT_TRUE(files.Add("line.las", SampleOf(line)).ok());
  EXPECT_TRUE(files.Add("other.las", SampleOf(other)).ok());
}

}  // namespace
}  // namespace albtpu::quality
