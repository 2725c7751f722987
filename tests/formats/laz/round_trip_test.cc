// Points written as LAZ files come back as they were, and with them everything else in the file.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <tuple>

#include "tests/formats/laz/busy_file.h"
#include "tests/formats/laz/busy_points.h"
#include "tests/formats/laz/laz_bytes.h"

namespace albtpu::testing {
namespace {

// Through one thread, and through two.
void ExpectComesBack(const LasParts& parts, const LazForm& form = {}) {
  const std::string laz = AsLaz(parts, form);
  for (const int threads : {1, 2}) {
    const auto again = TakeApart(laz, threads);
    EXPECT_TRUE(again->points == parts.points);
    EXPECT_TRUE(AsLas(*again) == AsLas(parts));
  }
}

class RoundTrip : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  RecordLayout layout() const { return {std::get<0>(GetParam()), static_cast<std::size_t>(std::get<1>(GetParam()))}; }
};

TEST_P(RoundTrip, KeepsBusyPoints) {
  const std::string most = BusyRecords(layout(), 50001);
  for (const std::size_t count : {0, 1, 49999, 50000, 50001}) {
    SCOPED_TRACE(std::to_string(count) + " points");
    ExpectComesBack(FileOf(layout(), most.substr(0, count * RecordLength(layout()))));
  }
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
