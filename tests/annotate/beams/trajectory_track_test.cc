#include "annotate/beams/trajectory_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/budget/beams/ray_flight.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using namespace albtpu::testing;  // Flight, RowAt and the fields of a row.
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kWater = 0;  // m

// Points below an SBET of two minutes, of which minute 0:20 to 1:20 has pulses with two returns under water. The
// scanner turns 20 degrees around the vertical; the rays have no errors.
class TrackFromFilesTest : public ::testing::Test {
 protected:
  TrackFromFilesTest() {
    file_.name = "in.las";
    auto map = formats::MapFrame::Create("in.las", {.user = "EPSG:32617"});
    file_.map = *map;
    const SbetRow middle = RowAt(flight_, 50);
    const formats::GeographicPosition position = {middle[kLatitude], middle[kLongitude]};
    const formats::MapPosition origin = file_.map->Project(position);
    const formats::MapMetric metric = file_.map->MetricAt(position);
    file_.frame = {.origin_x = origin.x,
                   .origin_y = origin.y,
                   .metres_per_x = metric.metres_per_x,
                   .metres_per_y = metric.metres_per_y};
    file_.extent = {
        .x_min = origin.x - 2000, .x_max = origin.x + 2000, .y_min = origin.y - 2000, .y_max = origin.y + 2000};
    file_.times = {{flight_.start + 20, flight_.start + 80}, formats::PointTimeForm::kWeekSeconds};
    plan_.source = TrajectoryFromFiles();
    const auto files =
        formats::LoadTrajectories(std::vector<std::string>{folder_.Write("flight.sbet", SbetBytes(Fly(flight_)))});
    plan_.trajectories = std::make_shared<const formats::TrajectoryFiles>(*files);
    AddRays(3000, 0);
  }

  // `count` rays from where the sensor was; their pulses have times `delay` later than the SBET states.
  void AddRays(int count, double delay) {
    file_.rays.clear();
    file_.times.span = {flight_.start + 20 + delay, flight_.start + 80 + delay};
    for (int i = 0; i < count; ++i) {
      const double time = 20 + 60.0 * i / count;
      const SbetRow row = RowAt(flight_, time);
      const formats::MapPosition at = file_.map->Project({row[kLatitude], row[kLongitude]});
      const Eigen::Vector3d sensor = file_.frame.At(at.x, at.y, row[kHeight]);
      const double azimuth = 2.4 * i;  // Directions are spread evenly.
      const double incidence = 20 * kDegree;
      const Eigen::Vector3d direction(std::sin(incidence) * std::sin(azimuth), std::sin(incidence) * std::cos(azimuth),
                                      -std::cos(incidence));
      file_.rays.push_back({.time = flight_.start + time + delay,
                            .water_point = sensor + direction * (sensor.z() - kWater) / std::cos(incidence),
                            .direction = direction,
                            .separation = 5});
    }
  }
  TrajectoryFromFiles& source() { return std::get<TrajectoryFromFiles>(plan_.source); }
  std::string Refusal() { return std::string(TrackFromFiles(file_, plan_).status().message()); }

  const Flight flight_ = {.duration = 120, .rate = 50};
  const TemporaryFolder folder_;
  TrackedFile file_;
  BeamPlan plan_;
};

TEST_F(TrackFromFilesTest, AgreesWithTheRaysOfItsFlight) {
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  EXPECT_EQ((*found->json)["check"]["verdict"], "agrees");
  EXPECT_EQ((*found->json)["check"]["rays"], 3000);
  // Linear steps of 0.02 s and single precision of the rays' own geometry: 1 mm of 400 m is 1.4e-4 degrees.
  EXPECT_NEAR((*found->json)["check"]["mean_incidence_difference"].get<double>(), 0, 1.4e-4);
  EXPECT_THAT(found->notes, ElementsAre(HasSubstr("agrees with 3000 pulses that have two returns under water")));
  const auto [positions, outcomes] = Ask(*found->track, {flight_.start + 50});
  EXPECT_EQ(outcomes[0], TrackOutcome::kKnown);
  EXPECT_NEAR(positions[0].x, file_.frame.origin_x, 1e-3);
  EXPECT_NEAR(positions[0].z, RowAt(flight_, 50)[kHeight], 1e-3);
}

TEST_F(TrackFromFilesTest, SaysWhenRaysAreTooFewToCompare) {
  AddRays(10, 0);
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  EXPECT_EQ((*found->json)["check"]["verdict"], "too few rays");
  EXPECT_THAT(found->notes, ElementsAre(HasSubstr("not compared with the returns (10 pulses")));
}

TEST_F(TrackFromFilesTest, RefusesAGeoidSeparationThatIsNotThere) {
  source().geoid_separation = 25;
  EXPECT_THAT(Refusal(), HasSubstr("in.las: its returns contradict the trajectory ("));
  EXPECT_THAT(Refusal(), HasSubstr("25.0 +- 0.0 m too low"));
}

TEST_F(TrackFromFilesTest, RefusesALeverArmThatIsNotThere) {
  source().lever_arm = {0, 9, 0};
  EXPECT_THAT(Refusal(), HasSubstr("9.0 +- 0.0 m"));
}

TEST_F(TrackFromFilesTest, NamesTheClockThatTheTrajectoryHas) {
  AddRays(3000, 18);
  EXPECT_THAT(Refusal(), HasSubstr("its times are UTC, 18 s behind GPS); give --trajectory-time utc"));
  source().utc = true;
  EXPECT_TRUE(TrackFromFiles(file_, plan_).ok());
  AddRays(3000, 0);
  EXPECT_THAT(Refusal(), HasSubstr("its times are GPS, 18 s after UTC); give --trajectory-time gps"));
}

TEST_F(TrackFromFilesTest, TakesLeapSecondsOfTheDayOfCreationAndSaysSo) {
  AddRays(3000, 17);
  source().utc = true;
  EXPECT_THAT(Refusal(), HasSubstr("its returns contradict the trajectory"));
  file_.times.created = formats::GpsTimeOfDay(2016, 132);
  const absl::StatusOr<FileTrack> in_2016 = TrackFromFiles(file_, plan_);
  ASSERT_TRUE(in_2016.ok()) << in_2016.status();
  EXPECT_THAT(in_2016->notes, ::testing::Contains(HasSubstr("is taken as 17 s, that of 2016-05-11")));
  AddRays(3000, 18);
  file_.times.created = std::nullopt;
  EXPECT_THAT(TrackFromFiles(file_, plan_)->notes, ::testing::Contains(HasSubstr("is taken as 18 s, that since 2017")));
}

// The same points with the times of other clocks than their header states. 300020 s of the week are Wednesday, 40820 s
// of its day; the week is 1896.
struct WrittenClock {
  const char* name;
  formats::PointTimeForm header;
  double shift, unit;  // Time as written = (second of the week + shift) unit.
};
constexpr double kBeginOfWeek = 1896 * 604800.0;  // s since 1980
constexpr double kOfDay = -3 * 86400.0;
constexpr auto kWeekHeader = formats::PointTimeForm::kWeekSeconds,
               kStandardHeader = formats::PointTimeForm::kAdjustedStandard;
constexpr WrittenClock kWrittenClocks[] = {
    {"week", kStandardHeader, 0, 1},
    {"adjusted", kWeekHeader, kBeginOfWeek - 1e9, 1},
    {"gps", kStandardHeader, kBeginOfWeek, 1},
    {"unix", kWeekHeader, kBeginOfWeek + 315964800 - 17, 1},
    {"unix", kStandardHeader, kBeginOfWeek + 315964800 - 17, 1},
    {"milliseconds", kWeekHeader, 0, 1000},
    {"milliseconds", kStandardHeader, kBeginOfWeek + 315964800 - 17, 1000},
    {"day", kWeekHeader, kOfDay, 1},
    {"day", kStandardHeader, kOfDay, 1},
    {"utc-day", kWeekHeader, kOfDay - 18, 1},
    {"utc-day", kStandardHeader, kOfDay - 18, 1},
};

TEST_F(TrackFromFilesTest, ReadsTheTimesOfEveryClockByWhatFits) {
  const auto [expected, known] = Ask(*TrackFromFiles(file_, plan_)->track, {flight_.start + 50});
  const TrackedFile right = file_;
  for (const WrittenClock& clock : kWrittenClocks) {
    const auto written = [&](double second) { return (second + clock.shift) * clock.unit; };
    file_ = right;
    file_.times = {{written(right.times.span.first), written(right.times.span.last)}, clock.header};
    for (AirRay& ray : file_.rays) ray.time = written(ray.time);
    for (std::size_t format = 0; format < formats::kTimeFormatNames.size(); ++format) {
      plan_.time_format = static_cast<formats::TimeFormat>(format);
      const bool is_auto = format == 0, is_right = formats::kTimeFormatNames[format] == clock.name;
      // Of the wrong ones, that named before the right one; all of them take seconds.
      const bool is_before =
          format + 1 < formats::kTimeFormatNames.size() && formats::kTimeFormatNames[format + 1] == clock.name;
      if (!is_auto && !is_right && !is_before && std::getenv("ALBTPU_EVERY_CASE") == nullptr) continue;
      const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
      ASSERT_EQ(found.ok(), is_auto || is_right)
          << clock.name << " as " << formats::kTimeFormatNames[format] << ": " << found.status();
      if (!found.ok()) continue;
      EXPECT_EQ((*found->json)["time_format"], clock.name);
      EXPECT_EQ((*found->json)["check"]["verdict"], "agrees");
      if (is_auto) {
        EXPECT_THAT(found->notes.back(), HasSubstr(std::string("--time-format ") + clock.name + " says so"));
      }
      const auto [positions, outcomes] = Ask(*found->track, {written(flight_.start + 50), 0, NAN, INFINITY});
      EXPECT_THAT(outcomes, ElementsAre(TrackOutcome::kKnown, TrackOutcome::kOutside, TrackOutcome::kOutside,
                                        TrackOutcome::kOutside));
      // Unix milliseconds are rounded to 2e-4 ms, adjusted times of 60 m/s to 3e-8 s.
      EXPECT_NEAR(positions[0].x, expected[0].x, 2e-5) << clock.name;
      EXPECT_NEAR(positions[0].z, expected[0].z, 2e-5) << clock.name;
      const std::optional<SensorMotion> motion = found->motions->At(written(flight_.start + 50));
      EXPECT_NEAR(motion->velocity[0], 60 * std::cos(30 * kDegree), 10) << clock.name;
      EXPECT_FALSE(found->motions->At(0).has_value());
    }
  }
}

TEST_F(TrackFromFilesTest, NamesTheClocksWhereSeveralFit) {
  // The same flight on Tuesday: seconds of the day fit both days.
  Flight before = flight_;
  before.start -= 86400;
  const std::vector<std::string> paths = {folder_.Write("wednesday.sbet", SbetBytes(Fly(flight_))),
                                          folder_.Write("tuesday.sbet", SbetBytes(Fly(before)))};
  plan_.trajectories = std::make_shared<const formats::TrajectoryFiles>(*formats::LoadTrajectories(paths));
  for (double* time : {&file_.times.span.first, &file_.times.span.last}) *time += kOfDay;
  for (AirRay& ray : file_.rays) ray.time += kOfDay;
  EXPECT_THAT(Refusal(), HasSubstr("seconds of the day, a Tuesday or as seconds of the day, a Wednesday"));
  EXPECT_THAT(Refusal(), HasSubstr("give the trajectory of this flight alone"));
}

// 40820 s of the day are 11:20:20.
TEST_F(TrackFromFilesTest, TakesNoSecondsOfTheDayForUtcOrGpsWithoutEvidence) {
  for (double* time : {&file_.times.span.first, &file_.times.span.last}) *time += kOfDay;
  for (AirRay& ray : file_.rays) ray.time += kOfDay;
  file_.times.created = formats::GpsTimeOfDay(2016, 132);
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_THAT(found->notes.back(), HasSubstr("seconds of the day, a Wednesday, not seconds of the GPS week"));
  EXPECT_THAT(found->notes.back(), HasSubstr("by its header, the file was created on Wednesday, 2016-05-11"));
  file_.rays.clear();
  EXPECT_THAT(Refusal(), HasSubstr("as seconds of the day, a Wednesday or as UTC seconds of the day, a Wednesday; give "
                                   "--time-format day or --time-format utc-day"));
  // An hour off, such as times of a zone.
  for (double* time : {&file_.times.span.first, &file_.times.span.last}) *time += 3600;
  EXPECT_THAT(Refusal(), HasSubstr("or, if its times are seconds of the day, 12:20:20 to 12:21:20 (its header states "
                                   "2016-05-11), the trajectory of that hour ("));
  EXPECT_THAT(Refusal(), HasSubstr("flight.sbet has 11:20:00 to 11:22:00 of a Wednesday), with --time-format day"));
}

TEST_F(TrackFromFilesTest, NamesTheClockThatFitsWhereTheUserNamesAnother) {
  plan_.time_format = formats::TimeFormat::kDay;
  EXPECT_THAT(Refusal(), HasSubstr("--time-format day says"));  // 300020 s are no day's.
  for (double* time : {&file_.times.span.first, &file_.times.span.last}) *time += kOfDay;
  for (AirRay& ray : file_.rays) ray.time += kOfDay;
  plan_.time_format = formats::TimeFormat::kUtcDay;
  EXPECT_THAT(Refusal(),
              HasSubstr("if --time-format utc-day is right, but as their GPS times are by --time-format day"));
  // UTC in the trajectory, GPS time in the points.
  plan_.time_format = formats::TimeFormat::kDay;
  for (double* time : {&file_.times.span.first, &file_.times.span.last}) *time += 18;
  for (AirRay& ray : file_.rays) ray.time += 18;
  EXPECT_THAT(Refusal(), HasSubstr("its times are UTC, 18 s behind GPS); give --trajectory-time utc"));
}

TEST_F(TrackFromFilesTest, RaysWithoutATimeDisturbNothing) {
  const auto [expected, known] = Ask(*TrackFromFiles(file_, plan_)->track, {flight_.start + 50});
  for (const double time : {0.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    file_.rays.insert(file_.rays.begin(), 5, file_.rays[7]);
    for (std::size_t i = 0; i < 5; ++i) file_.rays[i].time = time;
  }
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_EQ((*found->json)["check"]["rays"], 3000);
  const auto [positions, outcomes] = Ask(*found->track, {flight_.start + 50, 0, NAN, -INFINITY});
  EXPECT_THAT(outcomes, ElementsAre(TrackOutcome::kKnown, TrackOutcome::kOutside, TrackOutcome::kOutside,
                                    TrackOutcome::kOutside));
  EXPECT_EQ(positions[0].x, expected[0].x);
}

TEST_F(TrackFromFilesTest, SaysWhatWasRepairedInATrajectory) {
  const auto rows = Changed(Fly(flight_), [](SbetRow& row) {
    for (const SbetField field : {kVelocityX, kVelocityY, kVelocityZ}) row[field] = 0;
  });
  const auto files = formats::LoadTrajectories(std::vector<std::string>{folder_.Write("zero.sbet", SbetBytes(rows))});
  plan_.trajectories = std::make_shared<const formats::TrajectoryFiles>(*files);
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_THAT(found->notes, ::testing::Contains(HasSubstr("zero.sbet: its velocities are all 0")));
  EXPECT_NEAR(found->motions->At(flight_.start + 50)->velocity[0], 60 * std::cos(30 * kDegree), 10);
}

TEST_F(TrackFromFilesTest, RefusesATrajectoryFarFromThePoints) {
  file_.extent.x_min += 50e3;
  file_.extent.x_max += 50e3;
  EXPECT_THAT(Refusal(), HasSubstr("in.las"));
}

TEST_F(TrackFromFilesTest, RefusesATrajectoryOfAnotherTime) {
  AddRays(3000, 7200);
  EXPECT_THAT(Refusal(), HasSubstr("flight.sbet"));
}

TEST_F(TrackFromFilesTest, StatesHowWellTheTrajectoryIsKnown) {
  const auto errors =
      formats::LoadTrajectoryErrors(std::vector<std::string>{folder_.Write("smrmsg", SmrmsgBytes(flight_.start, 121))});
  plan_.trajectory_errors = *errors;
  const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
  // 50 s after its start, 0.04 m (1 + 5) down; 200 samples of a minute place the median within 0.3 s.
  EXPECT_NEAR((*found->json)["sigma"]["vertical"].get<double>(), 0.24, 0.04 * 0.031);
  EXPECT_THAT(found->notes[0], HasSubstr("trajectory known to 0.2"));
}

TEST_F(TrackFromFilesTest, RefusesErrorFilesOfAnotherTrajectory) {
  const auto errors =
      formats::LoadTrajectoryErrors(std::vector<std::string>{folder_.Write("smrmsg", SmrmsgBytes(0, 60))});
  plan_.trajectory_errors = *errors;
  EXPECT_THAT(Refusal(), HasSubstr("in.las: no error file of --trajectory-errors covers the times"));
}

// The same seconds of two weeks, of which an SBET names neither.
TEST_F(TrackFromFilesTest, TakesTheTrajectoryOfItsWeek) {
  const auto [expected, known] = Ask(*TrackFromFiles(file_, plan_)->track, {flight_.start + 50});
  Flight elsewhere = flight_, above = flight_;
  elsewhere.latitude += 1;
  above.height += 100;
  for (const Flight& other : {elsewhere, above}) {
    const auto files = formats::LoadTrajectories(
        std::vector<std::string>{folder_.Write("a.sbet", SbetBytes(Fly(other))), (folder_ / "flight.sbet").string()});
    plan_.trajectories = std::make_shared<const formats::TrajectoryFiles>(*files);
    const absl::StatusOr<FileTrack> found = TrackFromFiles(file_, plan_);
    ASSERT_TRUE(found.ok()) << found.status();
    EXPECT_THAT(found->notes.back(), HasSubstr("a.sbet is not of this flight and left out"));
    EXPECT_EQ(Ask(*found->track, {flight_.start + 50}).positions[0].x, expected[0].x);
  }
  // Without returns under water, nothing says which of two heights is right.
  file_.rays.clear();
  EXPECT_THAT(Refusal(), HasSubstr("their positions are 100.00 m apart"));
}

}  // namespace
}  // namespace albtpu::annotate
