// A build without MPI: one rank. Refuses to run as one of several.
#include "absl/strings/str_cat.h"
#include "generator/ranks/ranks.h"

namespace albtpu {
absl::StatusOr<std::unique_ptr<Ranks>> Ranks::Join() {
  if (const int launched = LaunchedRanks().value_or(1); launched > 1) {
    return absl::FailedPreconditionError(
        absl::StrCat("started as one of ", launched,
                     " ranks, but built without MPI (each rank would do all of the work); build with MPI "
                     "(libopenmpi-dev), or give each process its share with --shard"));
  }
  return OneRank();
}

}  // namespace albtpu
