#include "formats/trajectories/trajectory_timeline.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using namespace albtpu::testing;  // Flight, Fly, SbetRow and its fields.
using ::testing::HasSubstr;

class TrajectoryTimelineTest : public ::testing::Test {
 protected:
  std::shared_ptr<const Trajectory> Open(const std::string& name, const std::vector<SbetRow>& rows) {
    auto file = SbetFile::Open(folder_.Write(name, SbetBytes(rows)));
    EXPECT_TRUE(file.ok()) << file.status();
    return *std::move(file);
  }
  absl::StatusOr<TrajectoryTimeline> Create(const TrajectoryFiles& files, double first, double last) {
    return TrajectoryTimeline::Create(files, TrajectoryClock::kGps, {{first, last}, PointTimeForm::kWeekSeconds});
  }
  const TemporaryFolder folder_;
};

// The rows from `begin` to `end`, in seconds since the start.
std::vector<SbetRow> Part(const std::vector<SbetRow>& rows, double begin, double end) {
  std::vector<SbetRow> part;
  for (const SbetRow& row : rows) {
    const double time = row[kTime] - rows[0][kTime];
    if (time >= begin && time <= end) part.push_back(row);
  }
  return part;
}

TEST(Interpolate, TurnsAnglesTheShortWay) {
  TrajectoryRecord first, second;
  first.time = 10;
  second.time = 10.2;
  first.heading = 359 * kDegree;
  second.heading = 1 * kDegree;
  first.longitude = 179.9999 * kDegree;
  second.longitude = -179.9999 * kDegree;
  first.roll = second.roll = first.pitch = second.pitch = 0;
  const TrajectoryRecord middle = Interpolate(first, second, 10.1);
  EXPECT_NEAR(std::remainder(middle.heading, 2 * std::numbers::pi), 0, 1e-12);
  EXPECT_NEAR(std::abs(middle.longitude), 180 * kDegree, 1e-12);
}

TEST_F(TrajectoryTimelineTest, FollowsTheFlight) {
  const Flight flight;
  const auto timeline = Create({Open("a", Fly(flight))}, 300010, 300020);
  // Only what the points need is kept, and half a minute around it: the first record is at 300000.
  ASSERT_EQ(timeline->runs().size(), 1);
  EXPECT_EQ(timeline->runs()[0].span().first, 300000);
  EXPECT_NEAR(timeline->runs()[0].span().last, 300050, 0.0051);
  for (const double time : {10.0, 12.3456, 19.9999}) {
    const SbetRow row = RowAt(flight, time);
    const std::optional<TrajectoryRecord> record = timeline->RecordAt(300000 + time);
    ASSERT_TRUE(record.has_value());
    // Linear over 0.005 s: 1 m/s^2 (0.005 s)^2 / 8 = 3e-6 m, which is 5e-13 rad. Times are rounded to 6e-11 s.
    EXPECT_NEAR(record->latitude, row[kLatitude], 1e-12);
    EXPECT_NEAR(record->longitude, row[kLongitude], 1e-12);
    EXPECT_NEAR(record->height, row[kHeight], 3e-6);
    EXPECT_NEAR(std::remainder(record->heading - row[kPlatformHeading] + row[kWander], 2 * std::numbers::pi), 0, 1e-7);
  }
}

// Beside the largest number, which stands for no time in some files, the seconds of a trajectory vanish.
TEST_F(TrajectoryTimelineTest, RefusesTimesThatNoClockGives) {
  const auto file = Open("a", Fly(Flight()));
  for (const double time : {1e17, 1e300, std::numeric_limits<double>::max()}) {
    const auto timeline =
        TrajectoryTimeline::Create({file}, TrajectoryClock::kGps, {{time, time}, PointTimeForm::kAdjustedStandard});
    ASSERT_FALSE(timeline.ok()) << time;
    EXPECT_THAT(std::string(timeline.status().message()), HasSubstr(", which no clock gives")) << time;
  }
}

TEST_F(TrajectoryTimelineTest, KnowsNothingInAGap) {
  const std::vector<SbetRow> rows = Fly(Flight());
  std::vector<SbetRow> with_gap = Part(rows, 0, 20);
  for (const SbetRow& row : Part(rows, 23, 60)) with_gap.push_back(row);
  const auto timeline = Create({Open("a", with_gap)}, 300000, 300060);
  EXPECT_TRUE(timeline->RecordAt(300020).has_value());
  EXPECT_FALSE(timeline->RecordAt(300020.001).has_value());
  EXPECT_FALSE(timeline->RecordAt(300022.999).has_value());
  EXPECT_TRUE(timeline->RecordAt(300023).has_value());
  EXPECT_FALSE(timeline->RecordAt(299999.999).has_value());
  EXPECT_FALSE(timeline->RecordAt(300060.001).has_value());
  // Another file fills it.
  const auto filled = Create({Open("a", with_gap), Open("b", Part(rows, 15, 30))}, 300000, 300060);
  for (double time = 0; time <= 60; time += 0.013) ASSERT_TRUE(filled->RecordAt(300000 + time).has_value()) << time;
}

TEST_F(TrajectoryTimelineTest, PutsFilesInOrder) {
  const std::vector<SbetRow> rows = Fly(Flight());
  const auto timeline = Create({Open("c", Part(rows, 38, 60)), Open("a", Part(rows, 0, 20)),
                                Open("b", Part(rows, 18, 40)), Open("b again", Part(rows, 18, 40))},
                               300000, 300060);
  ASSERT_EQ(timeline->runs().size(), 3);
  for (std::size_t i = 1; i < 3; ++i) {
    const double end = timeline->runs()[i - 1].span().last;
    EXPECT_LE(timeline->runs()[i].span().first, end);
    EXPECT_GT(timeline->runs()[i].span().first, end - 0.0051);
  }
}

TEST_F(TrajectoryTimelineTest, RefusesFilesThatContradictEachOther) {
  const std::vector<SbetRow> rows = Fly(Flight());
  const auto shifted = [&](double height) {
    return Changed(Part(rows, 18, 40), [&](SbetRow& row) { row[kHeight] += height; });
  };
  const auto first = Open("first", Part(rows, 0, 20));
  EXPECT_TRUE(Create({first, Open("near", shifted(0.1))}, 300000, 300060).ok());
  const auto refused = Create({first, Open("far", shifted(0.7))}, 300000, 300060);
  EXPECT_THAT(std::string(refused.status().message()),
              ::testing::AllOf(HasSubstr("far: contradicts "), HasSubstr("/first: "), HasSubstr("0.70 m apart")));
}

TEST_F(TrajectoryTimelineTest, IgnoresFilesOfOtherTimes) {
  const auto here = Open("here", Fly(Flight()));
  const auto elsewhere = Open("elsewhere", Fly({.start = 400000}));
  EXPECT_TRUE(Create({here, elsewhere}, 300010, 300020).ok());
  EXPECT_THAT(std::string(Create({elsewhere, elsewhere}, 300010, 300020).status().message()),
              HasSubstr("none of 2 trajectories has records at the times of the points"));
  EXPECT_THAT(std::string(Create({elsewhere}, 300010, 300020).status().message()), HasSubstr("another flight"));
}

TEST_F(TrajectoryTimelineTest, RefusesRecordsThatAreTooFarApart) {
  EXPECT_THAT(std::string(Create({Open("slow", Fly({.rate = 1}))}, 300010, 300020).status().message()),
              HasSubstr("more than 0.2 s apart (the first two 1.000 s)"));
  EXPECT_TRUE(Create({Open("5 Hz", Fly({.rate = 5}))}, 300010, 300020).ok());
}

TEST_F(TrajectoryTimelineTest, FollowsPointsIntoTheNextWeek) {
  const Flight flight = {.start = 604770};
  const auto timeline = Create({Open("a", Fly(flight))}, 0, 604799.9);
  EXPECT_NEAR(timeline->RecordAt(604780)->latitude, RowAt(flight, 10)[kLatitude], 1e-12);
  EXPECT_NEAR(timeline->RecordAt(10)->latitude, RowAt(flight, 40)[kLatitude], 1e-12);
  EXPECT_FALSE(timeline->RecordAt(31).has_value());
}

}  // namespace
}  // namespace albtpu::formats
