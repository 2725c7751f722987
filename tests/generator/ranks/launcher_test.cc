#include <gtest/gtest.h>

#include <map>
#include <string>

#include "generator/ranks/ranks.h"

namespace albtpu {
namespace {

std::optional<int> Launched(const std::map<std::string, std::string>& environment) {
  return LaunchedRanks([&](const char* name) {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

TEST(Launcher, IsAbsentWithoutItsVariables) {
  EXPECT_EQ(Launched({}), std::nullopt);
  EXPECT_EQ(Launched({{"PMI_SIZE", "many"}}), std::nullopt);
}

TEST(Launcher, TellsTheNumberOfRanks) {
  EXPECT_EQ(Launched({{"OMPI_COMM_WORLD_SIZE", "4"}, {"PMIX_RANK", "2"}}), 4);
  EXPECT_EQ(Launched({{"PMI_SIZE", "3"}}), 3);
  EXPECT_EQ(Launched({{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "5"}}), 5);
}

TEST(Launcher, HasMoreRanksThanTheGreatestRankNumber) {
  EXPECT_EQ(Launched({{"PMIX_RANK", "2"}}), 3);
  EXPECT_EQ(Launched({{"PMIX_RANK", "0"}}), 1);
}

TEST(Launcher, IsNotASlurmArrayOfTasks) {
  EXPECT_EQ(Launched({{"SLURM_NTASKS", "8"}, {"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_ARRAY_TASK_ID", "3"}}),
            std::nullopt);
}

}  // namespace
}  // namespace albtpu
