#include "annotate/las/las_prescan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::LasPoint;
using albtpu::testing::LasSpec;
using albtpu::testing::TemporaryFolder;

using albtpu::testing::kBottom;
using albtpu::testing::kSurface;
const LasPrescanOptions kPairs = {.classes = {kBottom}, .water_classes = {}, .pairs = true, .water_level = {}};

LasPrescan PrescanOf(const LasSpec& spec, const LasPrescanOptions& options) {
  const TemporaryFolder folder;
  const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder.Write("in.las", BuildLas(spec)));
  absl::StatusOr<LasPrescan> prescan = Prescan(*reader, formats::LocalFrame(), options);
  EXPECT_TRUE(prescan.ok());
  return *std::move(prescan);
}

LasPoint Return(double time, double z, int point_class, int number, int count) {
  return {.z = static_cast<std::int32_t>(std::lround(z * 1000)),
          .classification = point_class,
          .gps_time = time,
          .return_number = number,
          .return_count = count};
}

TEST(LasPrescan, FindsPairsOfReturnsOfOnePulse) {
  LasSpec spec;
  spec.points = {Return(1, -1, 1, 1, 2),       Return(1, -3, kBottom, 2, 2),  // A pair.
                 Return(2, -1, 1, 1, 2),       Return(3, -3, kBottom, 2, 2),  // Different times.
                 Return(4, -1, 1, 1, 1),       Return(4, -3, kBottom, 1, 1),  // Two pulses of one time.
                 Return(5, -2.5, 1, 1, 2),     Return(5, -3, kBottom, 2, 2),  // Too near.
                 Return(6, 0, kSurface, 1, 2), Return(6, -3, kBottom, 2, 2),  // From the surface.
                 Return(7, -1, 7, 1, 2),       Return(7, -3, kBottom, 2, 2),  // Noise.
                 Return(8, -1, 1, 1, 2),       Return(8, -3, 1, 2, 2)};       // Not of the bottom.
  const LasPrescan prescan =
      PrescanOf(spec, {.classes = {kBottom}, .water_classes = {kSurface}, .pairs = true, .water_level = {}});
  ASSERT_EQ(prescan.pairs.size(), 1u);
  EXPECT_EQ(prescan.pair_count, 1u);
  EXPECT_EQ(prescan.pairs[0].time, 1);
  EXPECT_EQ(prescan.pairs[0].upper.z(), -1);
  EXPECT_EQ(prescan.pairs[0].lower.z(), -3);
  EXPECT_EQ(prescan.numbered, 6u);
  EXPECT_EQ(prescan.first_time, 1);
  EXPECT_EQ(prescan.last_time, 7);
  EXPECT_EQ(prescan.surface_returns, 1u);
}

TEST(LasPrescan, LeavesWithheldPointsOutUnlessTheyAreWanted) {
  for (const int format : {1, 6}) {
    LasSpec spec;
    spec.point_format = format;
    const int bottom = format == 6 ? 40 : 26, surface = format == 6 ? 41 : 9;
    spec.points = {Return(1, -1, 1, 1, 2), Return(1, -3, bottom, 2, 2), Return(2, 5, surface, 1, 1),
                   Return(9, -3, bottom, 1, 1)};
    LasPrescanOptions options = {.classes = {bottom}, .water_classes = {surface}, .pairs = true, .water_level = {}};
    for (LasPoint& point : spec.points) point.withheld = true;
    const LasPrescan none = PrescanOf(spec, options);
    EXPECT_EQ(none.numbered, 0u) << format;
    EXPECT_EQ(none.surface_returns, 0u) << format;
    EXPECT_EQ(none.pair_count, 0u) << format;
    EXPECT_EQ(none.all.greatest[2], 5) << format;
    options.use_withheld = true;
    const LasPrescan all = PrescanOf(spec, options);
    EXPECT_EQ(all.numbered, 2u) << format;
    EXPECT_EQ(all.surface_returns, 1u) << format;
    EXPECT_EQ(all.pair_count, 1u) << format;
  }
}

TEST(LasPrescan, TakesNoDirectionFromSyntheticPoints) {
  LasSpec spec;
  spec.points = {Return(1, -1, 1, 1, 2), Return(1, -3, kBottom, 2, 2), Return(2, 0, kSurface, 1, 1)};
  spec.points[0].synthetic = spec.points[2].synthetic = true;
  LasPrescanOptions options = kPairs;
  options.water_classes = {kSurface};
  const LasPrescan prescan = PrescanOf(spec, options);
  EXPECT_EQ(prescan.pair_count, 0u);
  EXPECT_EQ(prescan.surface_returns, 1u);
  EXPECT_EQ(prescan.synthetic_surface, 1u);
}

TEST(LasPrescan, TakesTimesOfZeroForNone) {
  LasSpec spec;
  spec.points = {Return(0, -1, 1, 1, 2), Return(0, -3, kBottom, 2, 2), Return(7, -3, kBottom, 1, 1),
                 Return(NAN, -3, kBottom, 1, 1), Return(8, -3, kBottom, 1, 1)};
  const LasPrescan prescan = PrescanOf(spec, kPairs);
  EXPECT_EQ(prescan.numbered, 4u);
  EXPECT_EQ(prescan.first_time, 7);
  EXPECT_EQ(prescan.last_time, 8);
  EXPECT_EQ(prescan.pair_count, 0u);
}

TEST(LasPrescan, ComparesReturnsFromTheSurfaceWithTheLevel) {
  LasSpec spec;
  spec.points = {Return(1, 0.5, kSurface, 1, 1), Return(2, -20, kSurface, 1, 1), Return(3, -22, kSurface, 1, 1),
                 Return(4, -30, kBottom, 1, 1)};
  LasPrescanOptions options = {
      .classes = {kBottom}, .water_classes = {}, .pairs = true, .water_level = 0, .level_classes = {kSurface}};
  const LasPrescan prescan = PrescanOf(spec, options);
  EXPECT_EQ(prescan.level_returns, 3u);
  EXPECT_EQ(prescan.off_level, 2u);
  EXPECT_EQ(prescan.off_level_height, -21);
  options.water_level = std::nullopt;
  EXPECT_EQ(PrescanOf(spec, options).level_returns, 0u);
}

TEST(LasPrescan, LeavesReturnsAboveTheWaterLevelOut) {
  LasSpec spec;
  spec.points = {Return(1, 2.5, 1, 1, 2), Return(1, -3, kBottom, 2, 2)};
  EXPECT_EQ(PrescanOf(spec, {.classes = {kBottom}, .water_classes = {}, .pairs = true, .water_level = 0}).pairs.size(),
            0u);
  EXPECT_EQ(PrescanOf(spec, {.classes = {kBottom}, .water_classes = {}, .pairs = true, .water_level = 1}).pairs.size(),
            1u);
}

TEST(LasPrescan, FindsPairsAcrossTheBordersOfChunks) {
  LasSpec spec;
  constexpr int kPulses = 200000;  // Several chunks of 4 MiB.
  for (int i = 0; i < kPulses; ++i) {
    spec.points.push_back(Return(1 + i * 0.01, -1, 1, 1, 2));
    spec.points.push_back(Return(1 + i * 0.01, -3, kBottom, 2, 2));
  }
  spec.points.erase(spec.points.begin());  // Chunks of an even number of records divide the pulses.
  EXPECT_EQ(PrescanOf(spec, kPairs).pair_count, kPulses - 1u);
}

// 200 pulses of three returns, 100 records apart.
LasSpec ScatteredPulses() {
  LasSpec spec;
  for (int number = 1; number <= 3; ++number)
    for (int i = 1; i <= 200; ++i) spec.points.push_back(Return(i * 0.01, -1.5 * number, kBottom, number, 3));
  return spec;
}

TEST(LasPrescan, FindsPairsOfReturnsThatLieFarApartInTheFile) {
  const LasSpec spec = ScatteredPulses();
  const LasPrescan scattered = PrescanOf(spec, kPairs);
  EXPECT_TRUE(scattered.is_scattered());
  EXPECT_EQ(scattered.of_several, 600u);
  EXPECT_EQ(scattered.alone, 600u);
  LasSpec sorted = spec;
  std::stable_sort(sorted.points.begin(), sorted.points.end(),
                   [](const LasPoint& a, const LasPoint& b) { return a.gps_time < b.gps_time; });
  const LasPrescan by_time = PrescanOf(sorted, kPairs);
  EXPECT_FALSE(by_time.is_scattered());
  EXPECT_EQ(by_time.alone, 0u);
  ASSERT_EQ(by_time.pairs.size(), 600u);
  ASSERT_EQ(scattered.pairs.size(), 600u);
  for (std::size_t i = 0; i < 600; ++i) {
    EXPECT_EQ(scattered.pairs[i].time, by_time.pairs[i].time);
    EXPECT_EQ(scattered.pairs[i].upper, by_time.pairs[i].upper);
    EXPECT_EQ(scattered.pairs[i].lower, by_time.pairs[i].lower);
  }
}

TEST(LasPrescan, FindsEachPairOnceWhereSomeReturnsLieApart) {
  LasSpec spec;
  for (int i = 1; i <= 40; ++i) {  // Returns 1 and 2 side by side, and 3 far from them, in steps of one record.
    spec.points.push_back(Return(i, -1.5, kBottom, 1, 3));
    spec.points.push_back(Return(i, -3, kBottom, 2, 3));
  }
  for (int i = 40; i >= 1; --i) spec.points.push_back(Return(i, -4.5, kBottom, 3, 3));
  const LasPrescan prescan = PrescanOf(spec, kPairs);
  EXPECT_FALSE(prescan.is_scattered());
  EXPECT_EQ(prescan.pair_count, 3u * 40u);
  EXPECT_EQ(prescan.pairs.size(), 3u * 40u);
}

TEST(LasPrescan, DoesNotPairReturnsOfPulsesThatShareACoarseTime) {
  LasSpec spec = ScatteredPulses();
  for (LasPoint& point : spec.points) point.gps_time = std::ceil(point.gps_time);
  // Neighbours of equal time and number are of different pulses, too.
  EXPECT_EQ(PrescanOf(spec, kPairs).pair_count, 0u);
}

TEST(LasPrescan, MakesASurfaceOfItsReturns) {
  LasSpec spec;
  for (int i = 0; i < 9; ++i) spec.points.push_back(Return(i, 0.25, kSurface, 1, 1));
  const LasPrescan prescan =
      PrescanOf(spec, {.classes = {kBottom}, .water_classes = {kSurface}, .pairs = false, .water_level = {}});
  ASSERT_TRUE(prescan.surface.has_value());
  EXPECT_EQ(prescan.surface->HeightAt(1, 1, 4), 0.25);
  EXPECT_EQ(prescan.surface->HeightAt(1000, 1, 4), std::nullopt);
  EXPECT_EQ(prescan.numbered, 0u);
}

}  // namespace
}  // namespace albtpu::annotate
