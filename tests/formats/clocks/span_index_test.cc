#include "formats/clocks/span_index.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace albtpu::formats {
namespace {

std::vector<std::size_t> Found(const SpanIndex& index, const TimeSpan& times) {
  std::vector<std::size_t> files;
  index.Find(times, files);
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SpanIndex, FindsWhatMeetsATime) {
  const SpanIndex index({{10, 20}, {0, 5}, {20, 30}, {0, 100}});
  EXPECT_THAT(Found(index, {20, 20}), ::testing::ElementsAre(0, 2, 3));
  EXPECT_THAT(Found(index, {6, 9}), ::testing::ElementsAre(3));
  EXPECT_THAT(Found(index, {-9, -1}), ::testing::IsEmpty());
  EXPECT_THAT(Found(index, {101, 102}), ::testing::IsEmpty());
  EXPECT_EQ(index.extent().first, 0);
  EXPECT_EQ(index.extent().last, 100);
  EXPECT_THAT(Found(SpanIndex(), {0, 1}), ::testing::IsEmpty());
}

// The slow twin looks at each span.
TEST(SpanIndex, FindsWhatLookingAtEachSpanFinds) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> time(0, 1000), length(0, 30);
  std::vector<TimeSpan> spans;
  for (int i = 0; i < 300; ++i) {
    const double first = time(random);
    spans.push_back({first, first + length(random)});
  }
  const SpanIndex index(spans);
  for (int i = 0; i < 1000; ++i) {
    const double first = time(random);
    const TimeSpan times = {first, first + length(random)};
    std::vector<std::size_t> expected;
    for (std::size_t file = 0; file < spans.size(); ++file)
      if (Overlap(spans[file], times) >= 0) expected.push_back(file);
    ASSERT_EQ(Found(index, times), expected) << times.first;
  }
}

}  // namespace
}  // namespace albtpu::formats
