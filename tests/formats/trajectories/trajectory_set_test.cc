#include <gmock/gmock.h>

#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"
#include "formats/trajectories/trajectory_timeline.h"
#include "tests/formats/trajectories/sbet_flight.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

absl::StatusOr<TrajectoryFiles> Load(const std::filesystem::path& path) {
  return LoadTrajectories(std::vector<std::string>{path.string()});
}

std::string Sbet() { return albtpu::testing::SbetBytes(albtpu::testing::Fly({.duration = 1})); }

TEST(TrajectorySet, LoadsTheTrajectoriesOfAFolderByName) {
  const albtpu::testing::TemporaryFolder folder;
  for (const char* name : {"b.OUT", "a.sbet", "c.Sbt", "sbet_mission_2.out", "smrmsg_mission.out", "vnav_rms.out",
                           "report.txt", "notes.pdf"})
    folder.Write(name, Sbet());
  const auto files = Load(folder.path());
  std::vector<std::string> names;
  for (const auto& file : *files) names.push_back(std::filesystem::path(file->name()).filename().string());
  EXPECT_THAT(names, ::testing::ElementsAre("a.sbet", "b.OUT", "c.Sbt", "sbet_mission_2.out"));
}

TEST(TrajectorySet, LoadsAFileOfAnyName) {
  const albtpu::testing::TemporaryFolder folder;
  EXPECT_TRUE(Load(folder.Write("rms report", Sbet())).ok());
}

TEST(TrajectorySet, RefusesAFolderWithoutTrajectories) {
  const albtpu::testing::TemporaryFolder folder;
  EXPECT_THAT(std::string(Load(folder.path()).status().message()), HasSubstr("no trajectory in this folder"));
  EXPECT_FALSE(Load(folder / "absent").ok());
}

TEST(TrajectorySet, RefusesAFileThatIsNoTrajectory) {
  const albtpu::testing::TemporaryFolder folder;
  folder.Write("a.sbet", Sbet());
  folder.Write("b.sbet", Sbet().substr(1));
  EXPECT_THAT(std::string(Load(folder.path()).status().message()), HasSubstr("b.sbet: "));
}

TEST(TrajectorySet, TellsTextFromBytesByContent) {
  const albtpu::testing::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(300000 + 0.1 * i) + " -81.8 " + std::to_string(26 + 0.1 * i * 60 / 110778) +
            " 0 0 400 0 0 0 0.02 0.02 0.03 0.01 0.01 0.02\n";
  }
  const auto files = Load(folder.Write("flight.sbet", text));
  EXPECT_NE(dynamic_cast<const AsciiTrajectory*>(files->front().get()), nullptr);
  const auto sbet = Load(folder.Write("flight.txt", Sbet()));
  EXPECT_NE(dynamic_cast<const SbetFile*>(sbet->front().get()), nullptr);
}

}  // namespace
}  // namespace albtpu::formats
