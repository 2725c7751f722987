// Ranks of a build without MPI.
#include <gmock/gmock.h>
#include <stdlib.h>

#include "generator/ranks/ranks.h"

namespace albtpu {
namespace {

class RanksAlone : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) unsetenv(name);
  }
  void TearDown() override { SetUp(); }
};

TEST_F(RanksAlone, AreOneRank) {
  const auto ranks = Ranks::Join();
  EXPECT_EQ((*ranks)->rank(), 0);
  EXPECT_EQ((*ranks)->size(), 1);
}

TEST_F(RanksAlone, AreOneRankUnderALauncherOfOne) {
  setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
  EXPECT_TRUE(Ranks::Join().ok());
}

TEST_F(RanksAlone, RefuseToBeOneOfSeveral) {
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  const absl::Status status = Ranks::Join().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()),
              ::testing::AllOf(::testing::HasSubstr("one of 4 ranks"), ::testing::HasSubstr("libopenmpi-dev"),
                               ::testing::HasSubstr("--shard")));
}

}  // namespace
}  // namespace albtpu
