#include "annotate/seas/sea_timeline.h"

#include <gmock/gmock.h>

#include <cmath>

#include "sea/sea_time.h"
#include "tests/annotate/seas/sea_series_text.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using albtpu::testing::kHour;
using albtpu::testing::kStart;

class SeaTimelineTest : public ::testing::Test {
 protected:
  config::SeaSettings File(const std::string& text) {
    config::SeaSettings sea;
    sea.file = folder_.Write("sea.txt", text).string();
    return sea;
  }
  // Records at these hours after kStart.
  config::SeaSettings Hours(const std::vector<double>& hours) {
    std::vector<testing::SeaAtTime> seas;
    for (const double hour : hours) seas.push_back({kStart + hour * kHour, 1});
    return File(testing::SeaCsv(seas));
  }
  std::string ErrorOf(const config::SeaSettings& settings) {
    const absl::StatusOr<SeaTimeline> seas = SeaTimeline::Open(settings);
    EXPECT_FALSE(seas.ok());
    EXPECT_THAT(std::string(seas.status().message()), StartsWith(*settings.file + ": "));
    return std::string(seas.status().message());
  }

  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(SeaTimelineTest, OfWavesIsOneSea) {
  config::SeaSettings settings;
  settings.waves.push_back({.significant_wave_height = 1, .peak_period = 6});
  settings.wind_speed = 5;
  const SeaTimeline seas = SeaTimeline::Open(settings).value();
  EXPECT_FALSE(seas.by_time());
  EXPECT_EQ(seas.fixed().weight, 0);
  EXPECT_EQ(seas.sea(0).wind_speed_10m, 5);
  EXPECT_TRUE(std::isinf(seas.sea(0).record_length));
}

TEST_F(SeaTimelineTest, GoesByTimeWithSeveralRecords) {
  const SeaTimeline seas = SeaTimeline::Open(Hours({0, 1, 2})).value();
  ASSERT_TRUE(seas.by_time());
  const BetweenRecords between = seas.At(kStart + 1.25 * kHour).value();
  EXPECT_EQ(between.first, 1u);
  EXPECT_EQ(between.second, 2u);
  EXPECT_EQ(between.weight, 0.25);
  for (int i = 0; i < 3; ++i) {
    const BetweenRecords exact = seas.At(kStart + i * kHour).value();
    EXPECT_EQ(exact.first, static_cast<std::size_t>(i));
    EXPECT_EQ(exact.second, exact.first);
    EXPECT_EQ(exact.weight, 0);
  }
  EXPECT_FALSE(seas.At(kStart - 0.1).has_value());
  EXPECT_FALSE(seas.At(kStart + 2 * kHour + 0.1).has_value());
  for (const double time : {double{NAN}, double{INFINITY}, -double{INFINITY}}) EXPECT_FALSE(seas.At(time).has_value());
}

TEST_F(SeaTimelineTest, BridgesShortGapsOnly) {
  const SeaTimeline seas = SeaTimeline::Open(Hours({0, 1, 2, 3, 6, 9.5, 10, 11})).value();
  EXPECT_EQ(seas.longest_gap(), 3 * kHour);
  EXPECT_TRUE(seas.At(kStart + 5 * kHour).has_value());
  EXPECT_FALSE(seas.At(kStart + 8 * kHour).has_value());
  EXPECT_TRUE(seas.At(kStart + 9.5 * kHour).has_value()) << "a record itself";
  EXPECT_TRUE(seas.At(kStart + 6 * kHour).has_value()) << "the record before the gap";
  config::SeaSettings settings = Hours({0, 1, 2, 3, 6, 9.5, 10, 11});
  settings.longest_gap = 4;
  EXPECT_TRUE(SeaTimeline::Open(settings)->At(kStart + 8 * kHour).has_value());
  settings.longest_gap = 0.9;
  EXPECT_FALSE(SeaTimeline::Open(settings)->At(kStart + 0.5 * kHour).has_value());
  // Of a model with steps of 4 hours one may be missing.
  EXPECT_EQ(SeaTimeline::Open(Hours({0, 4, 8, 12, 22}))->longest_gap(), 10 * kHour);
  // Days are not bridged unasked, even if they are all that the file has.
  EXPECT_EQ(SeaTimeline::Open(Hours({0, 24, 48, 72}))->longest_gap(), 15 * kHour);
  EXPECT_FALSE(SeaTimeline::Open(Hours({0, 24}))->At(kStart + 6 * kHour).has_value());
}

TEST_F(SeaTimelineTest, TakesTheInstantThatIsTold) {
  config::SeaSettings settings = Hours({0, 1, 2});
  settings.time = "2020-06-08T05:15Z";
  const SeaTimeline seas = SeaTimeline::Open(settings).value();
  EXPECT_FALSE(seas.by_time());
  EXPECT_EQ(seas.fixed().first, 1u);
  EXPECT_EQ(seas.fixed().second, 2u);
  EXPECT_EQ(seas.fixed().weight, 0.25);
  settings.time = "2020-06-08T05:00Z";
  EXPECT_EQ(SeaTimeline::Open(settings)->fixed().second, 1u);
  settings.time = "2020-06-08T07:00Z";
  EXPECT_THAT(ErrorOf(settings), HasSubstr("has no sea at 2020-06-08T07:00Z (its 3 records last from "
                                           "2020-06-08T04:00Z to 2020-06-08T06:00Z"));
}

TEST_F(SeaTimelineTest, FindsTheRecordsOfAFlight) {
  const SeaTimeline seas = SeaTimeline::Open(Hours({0, 1, 2, 3, 4})).value();
  const auto within = [&](double first, double last) {
    return seas.RecordsWithin(kStart + first * kHour, kStart + last * kHour);
  };
  EXPECT_EQ(within(1.2, 1.8), std::pair(std::size_t{1}, std::size_t{2}));
  EXPECT_EQ(within(1, 1), std::pair(std::size_t{1}, std::size_t{1}));
  EXPECT_EQ(within(0.5, 3.5), std::pair(std::size_t{0}, std::size_t{4}));
  EXPECT_EQ(within(-5, 50), std::pair(std::size_t{0}, std::size_t{4}));
}

constexpr char kTwoPlaces[] = R"(SWAN   1
LONLAT
2
-80.0 28.5
-79.0 29.5
AFREQ
2
0.1
0.2
NDIR
8
0
45
90
135
180
225
270
315
QUANT
1
VaDens
m2/Hz/degr
-0.9900E+02
FACTOR
0.1
1 1 1 1 1 1 1 1
1 1 1 1 1 1 1 1
FACTOR
0.2
1 1 1 1 1 1 1 1
1 1 1 1 1 1 1 1
)";

TEST_F(SeaTimelineTest, AsksForThePlace) {
  config::SeaSettings settings = File(kTwoPlaces);
  EXPECT_THAT(ErrorOf(settings),
              HasSubstr("has 2 places (28.5000,-80.0000; 29.5000,-79.0000); name one by --sea-place"));
  settings.place = "29.5000,-79.0000";
  EXPECT_EQ(SeaTimeline::Open(settings)->place(), "29.5000,-79.0000");
  settings.place = "28.6,-80.1";
  EXPECT_EQ(SeaTimeline::Open(settings)->place(), "28.5000,-80.0000");
  settings.place = "29.1,281";  // east, a full turn on
  EXPECT_EQ(SeaTimeline::Open(settings)->place(), "29.5000,-79.0000");
  settings.place = "Canaveral";
  EXPECT_THAT(ErrorOf(settings), HasSubstr("has no place 'Canaveral' (it has 28.5000,-80.0000; 29.5000,-79.0000)"));
}

TEST_F(SeaTimelineTest, RefusesATimeOfASeaWithoutOne) {
  config::SeaSettings settings = File("f,E\n0.1,1\n0.2,1\n");
  EXPECT_FALSE(SeaTimeline::Open(settings)->by_time());
  settings.time = "2020-06-08T05:15Z";
  EXPECT_THAT(ErrorOf(settings), HasSubstr("--sea-time has no effect"));
}

TEST_F(SeaTimelineTest, RefusesATailOfACompleteSea) {
  config::SeaSettings settings = File("k,S,a2,b2\n0.1,1,0,0\n0.2,1,0,0\n");
  EXPECT_TRUE(SeaTimeline::Open(settings).ok());
  settings.tail = "wind";
  EXPECT_THAT(ErrorOf(settings), HasSubstr("which is complete"));
}

TEST_F(SeaTimelineTest, NamesTheFileThatItCannotRead) {
  EXPECT_THAT(ErrorOf(File("hello\n")), HasSubstr("begins with 'hello'"));
  config::SeaSettings settings;
  settings.file = (folder_ / "absent").string();
  EXPECT_THAT(ErrorOf(settings), HasSubstr("does not exist"));
}

}  // namespace
}  // namespace albtpu::annotate
