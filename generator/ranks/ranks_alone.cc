// A build without MPI: one rank, and no mistake about it.
#include "absl/strings/str_cat.h"
#include "generator/ranks/launcher.h"
#include "generator/ranks/ranks.h"

namespace albtpu {
absl::StatusOr<std::unique_ptr<Ranks>> Ranks::Join() {
  if (const int launched = LaunchedRanks().value_or(1); launched > 1) {
    return absl::FailedPreconditionError(
        absl::StrCat("started as one of ", launched,
                     " ranks, but built without MPI, so that each would do all of the work: build with MPI "
                     "(libopenmpi-dev), or give each process its share with --shard"));
  }
  return OneRank();
}

}  // namespace albtpu
