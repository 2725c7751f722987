#include "annotate/beams/beam_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using namespace albtpu::testing;  // Flight, RowAt and the fields of a row.
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TrajectoryFilesTest : public ::testing::Test {
 protected:
  // Of a flight at points that have the times from `first` to `last`.
  formats::TrajectoryTimeline TimelineOf(const Flight& flight, double first, double last,
                                         formats::TrajectoryClock clock = formats::TrajectoryClock::kGps) {
    const auto files = formats::LoadTrajectories(
        std::vector<std::string>{folder_.Write("flight.sbet", SbetBytes(Fly(flight))).string()});
    auto timeline =
        formats::TrajectoryTimeline::Create(*files, clock, {{first, last}, formats::PointTimeForm::kWeekSeconds});
    EXPECT_TRUE(timeline.ok()) << timeline.status();
    return *std::move(timeline);
  }
  const TemporaryFolder folder_;
};

class TrajectoryMotionsTest : public TrajectoryFilesTest {
 protected:
  TrajectoryMotions Motions(const Flight& flight, const formats::TrajectoryErrors& errors) {
    const formats::TrajectoryTimeline timeline = TimelineOf(flight, flight.start, flight.start + flight.duration);
    return {timeline, *errors.Of(timeline)};
  }
};

TEST_F(TrajectoryMotionsTest, StatesAttitudeVelocityAndRatesOfTheFlight) {
  const Flight flight{.weave = 0, .climb = 0, .crab = 5};
  const TrajectoryMotions motions = Motions(flight, {});
  for (const double time : {10.0, 23.5, 41.25}) {
    const std::optional<SensorMotion> motion = motions.At(flight.start + time);
    ASSERT_TRUE(motion.has_value());
    EXPECT_NEAR(motion->velocity[0], 60 * std::cos(30 * kDegree), 0.3);
    EXPECT_NEAR(motion->velocity[1], 60 * std::sin(30 * kDegree), 0.3);
    EXPECT_NEAR(motion->velocity[2], 0, 1e-6);
    EXPECT_NEAR(motion->heading, 35, 0.2);
    EXPECT_NEAR(motion->roll, RowAt(flight, time)[kRoll] / kDegree, 1e-3);
    EXPECT_NEAR(motion->pitch, RowAt(flight, time)[kPitch] / kDegree, 1e-3);
    EXPECT_TRUE(std::isnan(motion->position_sigma[0]));
  }
  EXPECT_FALSE(motions.At(flight.start - 1).has_value());
  EXPECT_FALSE(motions.At(flight.start + flight.duration + 1).has_value());
}

TEST_F(TrajectoryMotionsTest, SinksWhereTheHeightFalls) {
  const Flight flight{.weave = 0, .climb = 10};
  const TrajectoryMotions motions = Motions(flight, {});
  for (const double time : {11.0, 17.0}) {
    const auto before = RowAt(flight, time - 0.01), after = RowAt(flight, time + 0.01);
    const double climbing = (after[kHeight] - before[kHeight]) / 0.02;
    EXPECT_GT(std::abs(climbing), 0.5);
    EXPECT_NEAR(motions.At(flight.start + time)->velocity[2], -climbing, 0.01);
  }
}

// The file states (field + 1) cm of each field, a tenth more each second; angles are in arc minutes.
TEST_F(TrajectoryMotionsTest, StatesTheErrorsOfItsFiles) {
  const Flight flight;
  const auto errors = formats::LoadTrajectoryErrors(
      std::vector<std::string>{folder_.Write("smrmsg.out", SmrmsgBytes(flight.start, 61)).string()});
  const std::optional<SensorMotion> motion = Motions(flight, *errors).At(flight.start + 20);
  ASSERT_TRUE(motion.has_value());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(motion->position_sigma[i], 0.01 * (i + 2) * 3, 1e-6);
    EXPECT_NEAR(motion->attitude_sigma[i], 0.01 * (i + 8) * 3 / 60, 1e-6);
  }
}

// Points count the seconds from 0 again at the end of the week, trajectories go on.
TEST_F(TrajectoryMotionsTest, StatesTheErrorsOfItsFilesAfterTheEndOfTheWeek) {
  const Flight flight{.start = formats::kSecondsPerWeek - 20};
  const auto errors = formats::LoadTrajectoryErrors(
      std::vector<std::string>{folder_.Write("smrmsg.out", SmrmsgBytes(flight.start, 61)).string()});
  const std::optional<SensorMotion> motion = Motions(flight, *errors).At(10);
  ASSERT_TRUE(motion.has_value());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion->position_sigma[i], 0.01 * (i + 2) * 4, 1e-6);
}

// A straight track in coordinates that are turned by 30 degrees and scaled.
class StraightTrack final : public SensorTrack {
 public:
  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override {
    for (std::size_t i = 0; i < times.size(); ++i) {
      positions[i] = {.x = 40 * times[i] / 0.9996,
                      .y = 30 * times[i] / 0.9996,
                      .z = 400 - 2 * times[i],
                      .metres_per_x = 0.9996,
                      .metres_per_y = 0.9996,
                      .convergence = 30 * kDegree};
      outcomes[i] = times[i] >= 0 && times[i] <= 10 ? TrackOutcome::kKnown : TrackOutcome::kOutside;
    }
  }
};

TEST(CourseMotions, AreTheTrueVelocityAndCourseOfATrack) {
  const StraightTrack track;
  const CourseMotions motions(track);
  // Grid azimuth atan(40 / 30), 53.130 degrees; true 83.130.
  for (const double time : {0.0, 5.0, 10.0}) {
    const std::optional<SensorMotion> motion = motions.At(time);
    ASSERT_TRUE(motion.has_value()) << time;
    EXPECT_NEAR(motion->heading, 83.1301, 1e-3);
    EXPECT_NEAR(motion->velocity[0], 50 * std::cos(83.1301 * kDegree), 1e-3);
    EXPECT_NEAR(motion->velocity[1], 50 * std::sin(83.1301 * kDegree), 1e-3);
    EXPECT_NEAR(motion->velocity[2], 2, 1e-6);
    EXPECT_EQ(motion->roll, 0);
    EXPECT_TRUE(std::isnan(motion->attitude_sigma[2]));
  }
  EXPECT_FALSE(motions.At(-1).has_value());
  EXPECT_FALSE(motions.At(11).has_value());
}

class TrajectoryErrorsTest : public TrajectoryFilesTest {
 protected:
  absl::StatusOr<formats::TrajectoryErrors> Load(const std::vector<std::filesystem::path>& paths) {
    return formats::LoadTrajectoryErrors(std::vector<std::string>(paths.begin(), paths.end()));
  }
  static std::optional<TrajectoryPrecision> Precision(const formats::TrajectoryErrors& errors,
                                                      const formats::TrajectoryTimeline& timeline) {
    return PrecisionOf(*errors.Of(timeline), timeline);
  }
  std::string Refusal(const std::filesystem::path& path) { return std::string(Load({path}).status().message()); }

  const Flight flight_ = {.duration = 60, .rate = 20};
};

TEST_F(TrajectoryErrorsTest, TakesTheErrorFilesOfAFolderByName) {
  folder_.Write("b_SMRMSG.out", SmrmsgBytes(200, 2));
  folder_.Write("a_rms.txt", SmrmsgBytes(100, 2));
  folder_.Write("flight.sbet", SbetBytes(Fly(flight_)));
  const absl::StatusOr<formats::TrajectoryErrors> errors = Load({folder_.path()});
  std::vector<double> starts;
  for (const auto& file : *errors) starts.push_back(file->TimeAt(0));
  EXPECT_THAT(starts, ElementsAre(100, 200));
}

TEST_F(TrajectoryErrorsTest, DecidesByContentsAndNotByNames) {
  folder_.Write("day2_Storms.sbet", SbetBytes(Fly(flight_)));
  folder_.Write("errors_of_day1.out", SmrmsgBytes(300, 2));
  folder_.Write("farms.dat", SmrmsgBytes(100, 2));
  folder_.Write("sigma.bin", SmrmsgBytes(200, 2));
  folder_.Write("notes.txt", "none");
  const absl::StatusOr<formats::TrajectoryErrors> errors = Load({folder_.path()});
  ASSERT_TRUE(errors.ok()) << errors.status();
  std::vector<double> starts;
  for (const auto& file : *errors) starts.push_back(file->TimeAt(0));
  EXPECT_THAT(starts, ElementsAre(300, 100, 200));
  EXPECT_THAT(errors->skipped(), ElementsAre(HasSubstr("skipped day2_Storms.sbet (trajectories by their contents)")));
}

TEST_F(TrajectoryErrorsTest, TakesAFileOfAnyName) {
  const absl::StatusOr<formats::TrajectoryErrors> errors = Load({folder_.Write("errors", SmrmsgBytes(100, 2))});
  EXPECT_EQ(errors->size(), 1u);
}

TEST_F(TrajectoryErrorsTest, RefusesWhatIsNoErrorFile) {
  EXPECT_THAT(Refusal(folder_.path()), HasSubstr("no error file in this folder"));
  EXPECT_THAT(Refusal(folder_ / "absent"), HasSubstr("absent"));
  EXPECT_THAT(Refusal(folder_.Write("flight.sbet", SbetBytes(Fly(flight_)))), HasSubstr("flight.sbet: "));
  folder_.Write("a_smrmsg.out", SmrmsgBytes(100, 2));
  folder_.Write("b_smrmsg.out", "not one");
  EXPECT_THAT(Refusal(folder_.path()), HasSubstr("b_smrmsg.out: "));
}

// i seconds after its start, an SMRMSG states 0.02 (1 + i / 10) m north, 0.03 (1 + i / 10) east, 0.04 (1 + i / 10)
// down. 200 samples of 10 s place the median within 0.05 s of the middle: 0.005 of the factor.
void ExpectFactor(const std::optional<TrajectoryPrecision>& precision, double factor) {
  ASSERT_TRUE(precision.has_value());
  EXPECT_NEAR(precision->horizontal, std::hypot(0.02, 0.03) * factor, std::hypot(0.02, 0.03) * 0.006);
  EXPECT_NEAR(precision->vertical, 0.04 * factor, 0.04 * 0.006);
}

TEST_F(TrajectoryErrorsTest, StateTheMedianWhereTheFileHasItsPoints) {
  const auto errors = Load({folder_.Write("smrmsg", SmrmsgBytes(300000, 61))});
  ExpectFactor(Precision(*errors, TimelineOf(flight_, 300010, 300020)), 2.5);
  ExpectFactor(Precision(*errors, TimelineOf(flight_, 300040, 300050)), 5.5);
}

TEST_F(TrajectoryErrorsTest, FollowTheClockOfTheirTrajectory) {
  const auto errors = Load({folder_.Write("smrmsg", SmrmsgBytes(300000, 61))});
  // Times of the trajectory and its errors are UTC; those of the points are 18 s ahead.
  ExpectFactor(Precision(*errors, TimelineOf(flight_, 300028, 300038, formats::TrajectoryClock::kUtc)), 2.5);
}

TEST_F(TrajectoryErrorsTest, ComeFromTheFileThatCoversTheTime) {
  const auto errors =
      Load({folder_.Write("first", SmrmsgBytes(100000, 61)), folder_.Write("second", SmrmsgBytes(300000, 61))});
  ExpectFactor(Precision(*errors, TimelineOf(flight_, 300010, 300020)), 2.5);
}

// Of two flights at the same hours of two weeks, the error file that begins and ends with the trajectory.
TEST_F(TrajectoryErrorsTest, AreThoseOfTheirFlight) {
  const std::string own = folder_.Write("own", SmrmsgBytes(300000, 61)),
                    other = folder_.Write("other", SmrmsgBytes(299900, 300));
  const formats::TrajectoryTimeline timeline = TimelineOf(flight_, 300010, 300020);
  for (const auto& files : {std::vector{own, other}, std::vector{other, own}}) {
    const auto errors = formats::LoadTrajectoryErrors(files)->Of(timeline);
    ASSERT_TRUE(errors.ok()) << errors.status();
    ExpectFactor(PrecisionOf(*errors, timeline), 2.5);
    EXPECT_THAT(errors->front().left_out, ElementsAre(other));
  }
  const std::string third = folder_.Write("third", SmrmsgBytes(299950, 200));
  EXPECT_THAT(std::string(formats::LoadTrajectoryErrors(std::vector{third, other})->Of(timeline).status().message()),
              HasSubstr("neither begins and ends with "));
  // Parts of one flight, at whose seams errors differ, contradict nothing.
  const std::string part = folder_.Write("part", SmrmsgBytes(300015, 200)),
                    before = folder_.Write("before", SmrmsgBytes(299900, 121));
  EXPECT_TRUE(formats::LoadTrajectoryErrors(std::vector{part, before})->Of(timeline).ok());
  // The same file twice contradicts nothing.
  EXPECT_EQ(formats::LoadTrajectoryErrors(std::vector{other, other})->Of(timeline)->front().files.size(), 2u);
}

TEST_F(TrajectoryErrorsTest, AreNotKnownAtOtherTimes) {
  const auto errors = Load({folder_.Write("smrmsg", SmrmsgBytes(100000, 61))});
  EXPECT_FALSE(Precision(*errors, TimelineOf(flight_, 300010, 300020)).has_value());
  EXPECT_FALSE(Precision({}, TimelineOf(flight_, 300010, 300020)).has_value());
}

}  // namespace
}  // namespace albtpu::annotate
