#include <gmock/gmock.h>

#include <cmath>

#include "annotate/beams/beam_plan.h"
#include "tests/formats/trajectories/flight_text.h"
#include "tests/formats/trajectories/sbet_flight.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::SmrmsgBytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TrajectoryErrorsTest : public ::testing::Test {
 protected:
  std::string Sbet(double start) {
    return albtpu::testing::SbetBytes(albtpu::testing::Fly({.start = start, .duration = 60, .rate = 20}));
  }
  absl::StatusOr<TrajectoryErrors> Load(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::string> names;
    for (const std::filesystem::path& path : paths) names.push_back(path.string());
    return LoadTrajectoryErrors(names);
  }
  std::string Refusal(const std::filesystem::path& path) { return std::string(Load({path}).status().message()); }
  // A flight from 300 000 to 300 060 s, of which points have the times from `first` to `last`.
  formats::TrajectoryTimeline Timeline(double first, double last,
                                       formats::TrajectoryClock clock = formats::TrajectoryClock::kGps) {
    const absl::StatusOr<formats::TrajectoryFiles> files =
        formats::LoadTrajectories(std::vector<std::string>{folder_.Write("flight.sbet", Sbet(300000)).string()});
    auto timeline =
        formats::TrajectoryTimeline::Create(*files, clock, {{first, last}, formats::PointTimeForm::kWeekSeconds});
    EXPECT_TRUE(timeline.ok()) << timeline.status();
    return *std::move(timeline);
  }
  const albtpu::testing::TemporaryFolder folder_;
};

TEST_F(TrajectoryErrorsTest, TakesTheErrorFilesOfAFolderByName) {
  folder_.Write("b_SMRMSG.out", SmrmsgBytes(200, 2));
  folder_.Write("a_rms.txt", SmrmsgBytes(100, 2));
  folder_.Write("flight.sbet", Sbet(300000));
  const absl::StatusOr<TrajectoryErrors> errors = Load({folder_.path()});
  std::vector<double> starts;
  for (const auto& file : *errors) starts.push_back(file->TimeAt(0));
  EXPECT_THAT(starts, ElementsAre(100, 200));
}

TEST_F(TrajectoryErrorsTest, TakesAFileOfAnyName) {
  const absl::StatusOr<TrajectoryErrors> errors = Load({folder_.Write("errors", SmrmsgBytes(100, 2))});
  EXPECT_EQ(errors->size(), 1u);
}

TEST_F(TrajectoryErrorsTest, RefusesWhatIsNoErrorFile) {
  EXPECT_THAT(Refusal(folder_.path()), HasSubstr("no error file in this folder"));
  EXPECT_THAT(Refusal(folder_ / "absent"), HasSubstr("absent"));
  EXPECT_THAT(Refusal(folder_.Write("flight.sbet", Sbet(300000))), HasSubstr("flight.sbet: "));
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
  ExpectFactor(PrecisionOf(*errors, Timeline(300010, 300020)), 2.5);
  ExpectFactor(PrecisionOf(*errors, Timeline(300040, 300050)), 5.5);
}

TEST_F(TrajectoryErrorsTest, FollowTheClockOfTheirTrajectory) {
  const auto errors = Load({folder_.Write("smrmsg", SmrmsgBytes(300000, 61))});
  // Times of the trajectory and its errors are UTC; those of the points are 18 s ahead.
  ExpectFactor(PrecisionOf(*errors, Timeline(300028, 300038, formats::TrajectoryClock::kUtc)), 2.5);
}

TEST_F(TrajectoryErrorsTest, ComeFromTheFileThatCoversTheTime) {
  const auto errors =
      Load({folder_.Write("first", SmrmsgBytes(100000, 61)), folder_.Write("second", SmrmsgBytes(300000, 61))});
  ExpectFactor(PrecisionOf(*errors, Timeline(300010, 300020)), 2.5);
}

TEST_F(TrajectoryErrorsTest, AreNotKnownAtOtherTimes) {
  const auto errors = Load({folder_.Write("smrmsg", SmrmsgBytes(100000, 61))});
  EXPECT_FALSE(PrecisionOf(*errors, Timeline(300010, 300020)).has_value());
  EXPECT_FALSE(PrecisionOf({}, Timeline(300010, 300020)).has_value());
}

}  // namespace
}  // namespace albtpu::annotate
