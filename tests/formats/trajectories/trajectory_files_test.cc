#include "formats/trajectories/trajectory_files.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using namespace albtpu::testing;  // Flight, Fly and FlightText.
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

absl::StatusOr<TrajectoryFiles> Load(const std::filesystem::path& path) {
  return LoadTrajectories(std::vector<std::string>{path.string()});
}

std::string Sbet() { return SbetBytes(Fly({.duration = 1})); }

std::vector<std::string> NamesOf(const TrajectoryFiles& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(std::filesystem::path(file->name()).filename().string());
  return names;
}

TEST(TrajectorySet, LoadsTheTrajectoriesOfAFolderInOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"b.OUT", "a.sbet", "c.Sbt", "sbet_mission_2.out"}) folder.Write(name, Sbet());
  const auto files = Load(folder.path());
  EXPECT_THAT(NamesOf(*files), ElementsAre("a.sbet", "b.OUT", "c.Sbt", "sbet_mission_2.out"));
  EXPECT_THAT(files->skipped(), IsEmpty());
}

TEST(TrajectorySet, DecidesByContentsAndNotByNames) {
  const TemporaryFolder folder;
  for (const char* name : {"day2_Storms.sbet", "report_line.out", "smrmsg_line.sbet", "farms.sbt", "vnav_rms.out"})
    folder.Write(name, Sbet());
  folder.Write("reports.txt", FlightText({}));
  const auto files = Load(folder.path());
  ASSERT_TRUE(files.ok()) << files.status();
  EXPECT_THAT(NamesOf(*files), ElementsAre("day2_Storms.sbet", "farms.sbt", "report_line.out", "reports.txt",
                                           "smrmsg_line.sbet", "vnav_rms.out"));
  EXPECT_THAT(files->skipped(), IsEmpty());
}

TEST(TrajectorySet, ListsWhatItSkipsWithTheReason) {
  const struct {
    const char* name;
    std::string bytes;
    const char* reason;
  } kSkipped[] = {
      {"day1.out", SmrmsgBytes(300000, 60), "error files (SMRMSG), which are given by --trajectory-errors"},
      {"day1.sbt", SmrmsgBytes(300000, 170), "error files (SMRMSG)"},  // 17 records of 80 bytes are 10 of 136.
      {"notes.txt", "Flown on Wednesday.\nGood weather.\n", "text without the 15 or 20 columns of a trajectory"},
      {"tide.csv", "time,water_level\n313200,-23.1\n313800,-23.2\n", "text without the 15 or 20 columns"},
      {"vnav_rms.out", std::string(1000, '\1'), "no trajectory that can be read: "},
      {"line.kml", "<kml/>", "other extensions than .sbet"},
  };
  for (const auto& skipped : kSkipped) {
    const TemporaryFolder folder;
    folder.Write("a.sbet", Sbet());
    folder.Write(skipped.name, skipped.bytes);
    const auto files = Load(folder.path());
    ASSERT_TRUE(files.ok()) << files.status();
    EXPECT_THAT(NamesOf(*files), ElementsAre("a.sbet"));
    EXPECT_THAT(files->skipped(), ElementsAre(AllOf(HasSubstr(std::string(": skipped ") + skipped.name + " ("),
                                                    HasSubstr(skipped.reason))));
  }
}

TEST(TrajectorySet, NamesTwentyOfTheFilesThatItSkips) {
  const TemporaryFolder folder;
  folder.Write("a.sbet", Sbet());
  for (int i = 10; i < 35; ++i) folder.Write("e" + std::to_string(i) + ".out", SmrmsgBytes(300000, 9));
  EXPECT_THAT(Load(folder.path())->skipped(), ElementsAre(HasSubstr("e10.out, e11.out, ")));
  EXPECT_THAT(Load(folder.path())->skipped(), ElementsAre(HasSubstr("e29.out and 5 more (error files")));
}

TEST(TrajectorySet, LoadsAFileOfAnyName) {
  const TemporaryFolder folder;
  EXPECT_TRUE(Load(folder.Write("rms report", Sbet())).ok());
}

TEST(TrajectorySet, RefusesAFolderWithoutTrajectories) {
  const TemporaryFolder folder;
  EXPECT_THAT(std::string(Load(folder.path()).status().message()), HasSubstr("no trajectory in this folder"));
  folder.Write("errors.out", SmrmsgBytes(300000, 9));
  EXPECT_THAT(std::string(Load(folder.path()).status().message()), HasSubstr("skipped errors.out (error files"));
  EXPECT_FALSE(Load(folder / "absent").ok());
}

TEST(TrajectorySet, RefusesAFileThatIsNoTrajectory) {
  for (const std::string& damaged : {Sbet().substr(1), Sbet().substr(0, 1000), std::string(), FlightText({}) + "x"}) {
    const TemporaryFolder folder;
    folder.Write("a.sbet", Sbet());
    folder.Write("b.sbet", damaged);
    EXPECT_THAT(std::string(Load(folder.path()).status().message()), HasSubstr("b.sbet")) << damaged.size();
  }
}

TEST(TrajectorySet, TellsTextFromBytesByContent) {
  const TemporaryFolder folder;
  const auto files = Load(folder.Write("flight.sbet", FlightText({})));
  EXPECT_NE(dynamic_cast<const AsciiTrajectory*>(files->front().get()), nullptr);
  const auto sbet = Load(folder.Write("flight.txt", Sbet()));
  EXPECT_NE(dynamic_cast<const SbetFile*>(sbet->front().get()), nullptr);
}

// A trajectory that has times and nothing else.
class Times final : public Trajectory {
 public:
  Times(double first, double last) : Trajectory("times", "SBET"), times_{first, last} {}
  std::size_t size() const override { return 2; }
  double TimeAt(std::size_t record) const override { return times_[record]; }
  TrajectoryRecord Record(std::size_t record) const override { return {.time = times_[record]}; }

 private:
  double times_[2];
};

// Of a survey of seven days, one flight each hour, the slow twin of the index asks TimeOffset for each file.
TEST(TrajectorySet, LooksAtTheFilesOfTheTimesOfThePoints) {
  constexpr double kWeek1896 = 1896 * kSecondsPerWeek;                          // s since 1980
  for (const double zero : {0.0, kWeek1896, kWeek1896 - kAdjustedGpsOffset}) {  // Week, GPS, adjusted.
    TrajectoryFiles::Files all;
    for (int hour = 0; hour < 168; ++hour)
      all.push_back(std::make_shared<Times>(zero + 3600 * hour + 100, zero + 3600 * hour + 1900));
    const TrajectoryFiles files(all);
    for (const auto form : {PointTimeForm::kWeekSeconds, PointTimeForm::kAdjustedStandard}) {
      for (const auto clock : {TrajectoryClock::kGps, TrajectoryClock::kUtc}) {
        const double begin = form == PointTimeForm::kWeekSeconds ? 0 : kWeek1896 - kAdjustedGpsOffset;
        for (double time = begin - 50000; time < begin + 700000; time += 47000) {
          const PointTimes points = {{time, time + 1500}, form};
          const std::vector<std::size_t> found = files.NearTimesOf(points);
          EXPECT_LE(found.size(), 3u);
          for (std::size_t i = 0; i < files.size(); ++i) {
            const TimeSpan span = {files[i]->TimeAt(0), files[i]->TimeAt(1)};
            if (!TimeOffset("times", span, clock, points).ok()) continue;
            ASSERT_TRUE(std::find(found.begin(), found.end(), i) != found.end()) << zero << " " << time << " " << i;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu::formats
