// Points written as LAZ files come back as they were, and with them everything else in the file.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <tuple>

#include "laz/coding/little_endian.h"
#include "laz/laz_points.h"
#include "tests/laz/busy_points.h"
#include "tests/laz/laz_bytes.h"

namespace albtpu::testing {
namespace {

TEST(BusyPoints, UseEachChannelReturnFlagAndManyClasses) {
  const RecordLayout layout{6, 0};
  const std::string records = BusyRecords(layout, 20000);
  std::set<int> channels, returns, flags, classes;
  bool backwards = false, negative = false, positive = false;
  std::array<double, 4> last_time{};
  for (std::size_t at = 0; at < records.size(); at += RecordLength(layout)) {
    const auto bits = laz::Load<std::uint8_t>(records, at + 15);
    const int channel = bits >> 4 & 3;
    channels.insert(channel);
    flags.insert(bits & 15);
    returns.insert(laz::Load<std::uint8_t>(records, at + 14));
    classes.insert(laz::Load<std::uint8_t>(records, at + 16));
    const auto angle = laz::Load<std::int16_t>(records, at + 18);
    negative |= angle < 0;
    positive |= angle > 0;
    const auto time = laz::Load<double>(records, at + 22);
    backwards |= time < last_time[channel];
    last_time[channel] = time;
  }
  EXPECT_EQ(channels.size(), 4u);
  EXPECT_EQ(flags.size(), 16u);
  EXPECT_GT(returns.size(), 100u);
  EXPECT_GT(classes.size(), 100u);
  EXPECT_TRUE(backwards && negative && positive);
}

// Through one thread, and through two.
void ExpectComesBack(const LasParts& parts, const LazForm& form = {}) {
  const std::string laz = AsLaz(parts, form);
  for (const int threads : {1, 2}) {
    const auto again = TakeApart(laz, threads);
    EXPECT_TRUE(again->points == parts.points);
    EXPECT_TRUE(AsLas(*again) == AsLas(parts));
  }
  const laz::LazExtent extent = *ExtentOf(laz);
  if (extent.point_count == 0) return;
  const absl::StatusOr<std::string> first = laz::LazPoints::First(laz::MemorySource(laz), extent);
  EXPECT_TRUE(*first == parts.points.substr(0, first->size()));
}

class RoundTrip : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  RecordLayout layout() const { return {std::get<0>(GetParam()), static_cast<std::size_t>(std::get<1>(GetParam()))}; }
};

// A whole chunk of the usual size is long enough for each model of symbols to halve its counts many times.
TEST_P(RoundTrip, KeepsBusyPoints) {
  const std::string most = BusyRecords(layout(), laz::kCommonChunkSize + 1);
  const auto expect_first = [&](std::size_t count, std::uint32_t chunk_size) {
    SCOPED_TRACE(std::to_string(count) + " points in chunks of " + std::to_string(chunk_size));
    ExpectComesBack(FileOf(layout(), most.substr(0, count * RecordLength(layout()))), {.chunk_size = chunk_size});
  };
  for (const std::size_t count : {0, 1, 50001}) expect_first(count, laz::kCommonChunkSize);
  for (const std::size_t count : {4999, 5000, 5001}) expect_first(count, 5000);
}

TEST_P(RoundTrip, KeepsPointsOfAFlightLine) {
  const LasParts parts = FileOf(layout(), CalmRecords(layout(), 50001));
  ExpectComesBack(parts);
  EXPECT_LT(AsLaz(parts).size(), AsLas(parts).size() / 3);
}

TEST_P(RoundTrip, KeepsPointsInChunksOfEverySize) {
  const LasParts parts = FileOf(layout(), BusyRecords(layout(), 2050));
  for (const std::uint32_t chunk_size : {7u, 1024u, 2049u, 0xFFFFFFFEu, laz::kVariableChunks}) {
    SCOPED_TRACE(std::to_string(chunk_size) + " points");
    ExpectComesBack(parts, {.chunk_size = chunk_size});
  }
  ExpectComesBack(FileOf(layout(), BusyRecords(layout(), 20)), {.chunk_size = 1});
}

TEST_P(RoundTrip, KeepsPointsWhereverTheTableIs) {
  const LasParts parts = FileOf(layout(), BusyRecords(layout(), 2050));
  ExpectComesBack(parts, {.chunk_size = 1000, .table = TableForm::kAtEnd});
  ExpectComesBack(parts, {.chunk_size = laz::kVariableChunks, .table = TableForm::kAtEnd});
  // Not with chunks of any size: nothing but the table says where one ends.
  ExpectComesBack(parts, {.chunk_size = 1000, .table = TableForm::kNone});
}

INSTANTIATE_TEST_SUITE_P(, RoundTrip, ::testing::Combine(::testing::Range(0, 11), ::testing::Values(0, 1, 4, 27)),
                         [](const auto& parameter) {
                           return "Format" + std::to_string(std::get<0>(parameter.param)) + "And" +
                                  std::to_string(std::get<1>(parameter.param)) + "ExtraBytes";
                         });

}  // namespace
}  // namespace albtpu::testing
