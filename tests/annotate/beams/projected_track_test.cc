#include "annotate/beams/projected_track.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "formats/trajectories/sbet_file.h"
#include "tests/budget/beams/ray_flight.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using namespace albtpu::testing;  // Flight, Fly, SbetRow and its fields.
using ::testing::HasSubstr;

class ProjectedTrackTest : public ::testing::Test {
 protected:
  std::shared_ptr<const formats::Trajectory> Open(const std::string& name, const std::vector<SbetRow>& rows) {
    auto file = formats::SbetFile::Open(folder_.Write(name, SbetBytes(rows)));
    EXPECT_TRUE(file.ok()) << file.status();
    return *std::move(file);
  }
  std::unique_ptr<ProjectedTrack> Track(const formats::TrajectoryFiles& files, const std::string& crs,
                                        formats::TimeSpan span, const ProjectedTrackOptions& options = {}) {
    auto timeline = formats::TrajectoryTimeline::Create(files, formats::TrajectoryClock::kGps,
                                                        {span, formats::PointTimeForm::kWeekSeconds});
    EXPECT_TRUE(timeline.ok()) << timeline.status();
    auto frame = formats::MapFrame::Create("in.las", {.user = crs});
    auto track = ProjectedTrack::Create(*std::move(timeline), *frame, options);
    EXPECT_TRUE(track.ok()) << track.status();
    return *std::move(track);
  }
  // Every answer is that of the slow way: find the record by halving, interpolate it, project it.
  void ExpectSlowAnswers(const ProjectedTrack& track, const std::vector<double>& times, double unit) {
    const TrackAnswer answer = Ask(track, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::optional<formats::TrajectoryRecord> record = track.timeline().RecordAt(times[i]);
      ASSERT_EQ(answer.outcomes[i], record.has_value() ? TrackOutcome::kKnown : TrackOutcome::kOutside) << times[i];
      if (!record.has_value()) continue;
      const SensorPosition slow = track.PositionOf(*record);
      const SensorPosition& fast = answer.positions[i];
      // A step of 12 m: a straight line in latitude and longitude leaves the one on the map by 12^2 / (8 R) times the
      // tangent of the latitude, 5e-6 m. An arm of 2 m whose attitude turns by 1 degree within the step leaves its
      // chord by 2 m (0.017)^2 / 8 = 8e-5 m.
      EXPECT_NEAR(fast.x, slow.x, 1e-4 / unit) << times[i];
      EXPECT_NEAR(fast.y, slow.y, 1e-4 / unit) << times[i];
      EXPECT_NEAR(fast.z, slow.z, 1e-4) << times[i];
      // Single precision, 6e-8 of the number. Between two nodes, 3.2 s apart at 5 Hz, a weave of 0.88 m/s^2 leaves the
      // straight line by 0.88 x 3.2^2 / 8 = 1.1 m, and the convergence changes by tan(26 degrees) / R in a metre.
      EXPECT_NEAR(fast.metres_per_x / slow.metres_per_x, 1, 1.3e-7);
      EXPECT_NEAR(fast.metres_per_y / slow.metres_per_y, 1, 1.3e-7);
      EXPECT_NEAR(fast.convergence, slow.convergence, 1e-7);
    }
  }
  const TemporaryFolder folder_;
};

std::vector<double> RandomTimes(double first, double last, int count) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(first, last);
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(uniform(random));
  return times;
}

TEST_F(ProjectedTrackTest, AgreesWithItsSlowTwin) {
  const ProjectedTrackOptions options = {.lever_arm = {1.5, -0.8, 1}, .geoid_separation = -25};
  for (const double rate : {5.0, 200.0}) {
    const auto file = Open("a", Fly({.rate = rate, .longitude = -83.9}));
    for (const char* crs : {"EPSG:32617", "EPSG:2236", "EPSG:4269"}) {
      const auto track = Track({file}, crs, {299990, 300070}, options);
      const double unit = crs == std::string("EPSG:4269") ? 111000 : 1;
      std::vector<double> times = RandomTimes(299999, 300061, 2000);
      ExpectSlowAnswers(*track, times, unit);
      std::sort(times.begin(), times.end());
      ExpectSlowAnswers(*track, times, unit);
      std::reverse(times.begin(), times.end());
      ExpectSlowAnswers(*track, times, unit);
    }
  }
}

TEST_F(ProjectedTrackTest, KnowsEveryRecord) {
  const std::vector<SbetRow> rows = Fly(Flight());
  const auto track = Track({Open("a", rows)}, "EPSG:32617", {299990, 300070});
  std::vector<double> times;
  for (const SbetRow& row : rows) times.push_back(row[kTime]);
  ExpectSlowAnswers(*track, times, 1);
  const TrackAnswer answer = Ask(*track, times);
  EXPECT_TRUE(std::all_of(answer.outcomes.begin(), answer.outcomes.end(),
                          [](TrackOutcome outcome) { return outcome == TrackOutcome::kKnown; }));
}

TEST_F(ProjectedTrackTest, KnowsNothingInAGapOrOutside) {
  std::vector<SbetRow> rows = Fly(Flight());
  std::erase_if(rows, [](const SbetRow& row) { return row[kTime] > 300020.0001 && row[kTime] < 300022.9999; });
  const auto track = Track({Open("a", rows)}, "EPSG:32617", {299990, 300070});
  const TrackAnswer answer = Ask(*track, {299999.9, 300000, 300020, 300020.01, 300022.99, 300023, 300060, 300060.01,
                                          std::nan(""), -INFINITY, INFINITY, 300010});
  using enum TrackOutcome;
  EXPECT_THAT(answer.outcomes, ::testing::ElementsAre(kOutside, kKnown, kKnown, kOutside, kOutside, kKnown, kKnown,
                                                      kOutside, kOutside, kOutside, kOutside, kKnown));
}

TEST_F(ProjectedTrackTest, JoinsFiles) {
  const std::vector<SbetRow> rows = Fly(Flight());
  const auto part = [&](double first, double last, std::size_t every) {
    std::vector<SbetRow> result;
    for (std::size_t i = 0; i < rows.size(); i += every)
      if (rows[i][kTime] >= first && rows[i][kTime] <= last) result.push_back(rows[i]);
    return result;
  };
  // Of different rates, so that records of one lie between records of the other.
  const auto track = Track(
      {Open("a", part(300000, 300021.505, 1)), Open("b", part(300019, 300045, 37)), Open("c", part(300044, 300060, 1))},
      "EPSG:32617", {299990, 300070});
  const std::vector<double> times = RandomTimes(300000, 300060, 5000);
  const TrackAnswer answer = Ask(*track, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    ASSERT_EQ(answer.outcomes[i], TrackOutcome::kKnown) << times[i];
    const SbetRow row = RowAt(Flight(), times[i] - 300000);
    formats::TrajectoryRecord truth;
    truth.latitude = row[kLatitude];
    truth.longitude = row[kLongitude];
    truth.height = row[kHeight];
    const SensorPosition position = track->PositionOf(truth);
    // Linear over 37 x 0.005 s: 1.4 m/s^2 (0.185 s)^2 / 8 = 6 mm.
    EXPECT_NEAR(answer.positions[i].x, position.x, 0.006);
    EXPECT_NEAR(answer.positions[i].y, position.y, 0.006);
    EXPECT_NEAR(answer.positions[i].z, position.z, 0.006);
  }
}

TEST_F(ProjectedTrackTest, FollowsPointsIntoTheNextWeek) {
  const auto track = Track({Open("a", Fly({.start = 604770}))}, "EPSG:32617", {0, 604799.9});
  ExpectSlowAnswers(*track, {604771, 604799.9975, 0, 0.0025, 29.9, 604780, 5, 30.5}, 1);
}

TEST_F(ProjectedTrackTest, SubtractsTheGeoidSeparation) {
  const auto file = Open("a", Fly({.climb = 0}));
  const auto track = Track({file}, "EPSG:32617", {300000, 300060}, {.geoid_separation = -25.5});
  EXPECT_DOUBLE_EQ(Ask(*track, {300030}).positions[0].z, 425.5);
}

TEST_F(ProjectedTrackTest, GivesTheSameNumbersToEveryThread) {
  const auto track = Track({Open("a", Fly({.duration = 120}))}, "EPSG:32617", {300000, 300120});
  const std::vector<double> times = RandomTimes(300000, 300120, 20000);
  std::array<TrackAnswer, 4> answers;
  std::vector<std::thread> threads;
  for (TrackAnswer& answer : answers) threads.emplace_back([&] { answer = Ask(*track, times); });
  for (std::thread& thread : threads) thread.join();
  for (const TrackAnswer& answer : answers) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      ASSERT_EQ(answer.outcomes[i], TrackOutcome::kKnown);
      ASSERT_EQ(answer.positions[i].x, answers[0].positions[i].x);
    }
  }
}

TEST(LeverArm, TurnsWithTheBody) {
  const auto expect = [](const NorthEastDown& arm, double north, double east, double down) {
    EXPECT_NEAR(arm.north, north, 1e-15);
    EXPECT_NEAR(arm.east, east, 1e-15);
    EXPECT_NEAR(arm.down, down, 1e-15);
  };
  const double quarter = 90 * kDegree;
  expect(Turned({1, 2, 3}, 0, 0, 0), 1, 2, 3);
  expect(Turned({1, 2, 3}, 0, 0, quarter), -2, 1, 3);  // Nose to the east: right is south.
  expect(Turned({1, 2, 3}, quarter, 0, 0), 1, -3, 2);  // Right side down: down is to the left.
  expect(Turned({1, 2, 3}, 0, quarter, 0), 3, 2, -1);  // Nose up: down is to the front.
  // Roll first, then pitch, then heading.
  expect(Turned({0, 0, 1}, quarter, quarter, 0), 0, -1, 0);
  expect(Turned({0, 1, 0}, quarter, quarter, quarter), 0, 1, 0);
}

TEST_F(ProjectedTrackTest, MovesTheSensorByTheLeverArm) {
  const std::vector<SbetRow> rows =
      Fly({.longitude = -78.2, .course = 40, .weave = 0, .climb = 0, .roll = 0, .pitch = 0});
  const auto file = Open("a", rows);
  const auto bare = Track({file}, "EPSG:32617", {300000, 300060});
  const auto with = Track({file}, "EPSG:32617", {300000, 300060}, {.lever_arm = {3, 0, 0.5}});
  const SensorPosition a = Ask(*bare, {300030}).positions[0], b = Ask(*with, {300030}).positions[0];
  const double x = (b.x - a.x) * a.metres_per_x, y = (b.y - a.y) * a.metres_per_y;
  // The ground at a height of 400 m is 6e-5 longer than on the ellipsoid: 0.2 mm of 3 m.
  EXPECT_NEAR(std::hypot(x, y), 3, 2.5e-4);
  const SbetRow row = RowAt({.longitude = -78.2, .course = 40, .weave = 0}, 30);
  EXPECT_NEAR(std::atan2(x, y) + a.convergence, row[kPlatformHeading] - row[kWander], 1e-5);
  EXPECT_NEAR(b.z - a.z, -0.5, 1e-9);
}

// A trajectory without attitude.
class Positions : public formats::Trajectory {
 public:
  Positions() : formats::Trajectory("positions", "none") {}
  std::size_t size() const override { return 100; }
  double TimeAt(std::size_t record) const override { return 300000 + 0.1 * static_cast<double>(record); }
  formats::TrajectoryRecord Record(std::size_t record) const override {
    formats::TrajectoryRecord result;
    result.time = TimeAt(record);
    result.latitude = 26 * kDegree;
    result.longitude = -81 * kDegree;
    return result;
  }
};

TEST_F(ProjectedTrackTest, NeedsAttitudeForALeverArm) {
  const auto timeline =
      formats::TrajectoryTimeline::Create({std::make_shared<Positions>()}, formats::TrajectoryClock::kGps,
                                          {{300000, 300009}, formats::PointTimeForm::kWeekSeconds});
  const auto frame = formats::MapFrame::Create("in.las", {.user = "EPSG:32617"});
  EXPECT_THAT(std::string(ProjectedTrack::Create(*timeline, *frame, {.lever_arm = {0, 0, 1}}).status().message()),
              HasSubstr("--lever-arm: needs roll, pitch and heading"));
  EXPECT_TRUE(ProjectedTrack::Create(*timeline, *frame, {}).ok());
}

}  // namespace
}  // namespace albtpu::annotate
