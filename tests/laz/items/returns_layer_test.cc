// The contexts that the first layer tells all others, by hand.
#include "laz/items/returns_layer.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "laz/coding/arithmetic_encoder.h"

namespace albtpu::laz {
namespace {

struct Path {
  std::size_t models, from, to;
  bool operator==(const Path&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Path& path) {
  return out << path.models << " from " << path.from << " to " << path.to;
}

struct Paths {
  std::vector<Path> common, version3;
};

// Of points in these scanner channels, without the first one.
Paths PathsOf(const std::vector<int>& channels) {
  std::string points(channels.size() * kPoint14Size, '\0');
  for (std::size_t i = 0; i < channels.size(); ++i)
    points[i * kPoint14Size + kFlagsOffset] = static_cast<char>(channels[i] << 4);
  ReturnsLayer<ArithmeticEncoder> layer;
  layer.Begin(points.data());
  ArithmeticEncoder encoder;
  encoder.Begin();
  const auto contexts = std::make_unique<PointContexts>();
  layer.Code(encoder, {points.data() + kPoint14Size, kPoint14Size, channels.size() - 1}, *contexts);
  Paths paths;
  const auto expand = [](const ChannelRuns& runs, std::vector<Path>& of_points) {
    for (const ChannelRun& run : runs)
      of_points.insert(of_points.end(), run.end - run.begin, {run.models, run.from, run.to});
  };
  expand(contexts->runs, paths.common);
  expand(contexts->version3_runs, paths.version3);
  return paths;
}

TEST(ReturnsLayer, APointFollowsTheLastOneOfItsChannelOrTheOneBeforeANewChannel) {
  EXPECT_EQ(PathsOf({0, 0, 1, 1, 0, 1, 2}).common,
            (std::vector<Path>{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {2, 1, 2}}));
}

TEST(ReturnsLayer, ItemsOfVersion3FallBackToChannelZeroAndTakeTheLastPointAlong) {
  EXPECT_EQ(PathsOf({0, 0, 1, 1, 0, 1, 2}).version3,
            (std::vector<Path>{{0, 0, 0},  // Channel 0 goes on.
                               {1, 0, 1},  // Channel 1 begins after the last point of channel 0.
                               {0, 1, 1},  // It is not stated again: back to the models of 0, with the last point of 1.
                               {0, 0, 0},  // Stated, and the models are those of 0 already.
                               {1, 0, 0},  // The models of 1 are in use: with the last point of 0.
                               {2, 1, 2}}));  // Channel 2 begins after the last point of channel 1.
}

TEST(ReturnsLayer, ItemsOfVersion3LeaveTheChannelOfTheFirstPoint) {
  EXPECT_EQ(PathsOf({2, 2, 2}).version3, (std::vector<Path>{{0, 2, 0}, {0, 0, 0}}));
  EXPECT_EQ(PathsOf({2, 2, 2}).common, (std::vector<Path>{{2, 2, 2}, {2, 2, 2}}));
}

}  // namespace
}  // namespace albtpu::laz
