// Detects from the environment whether a launcher started this process as one of several ranks of one program.
#pragma once

#include <functional>
#include <optional>

namespace albtpu {

// The number of ranks, or a lower bound where the launcher does not state it; nullopt where no launcher of ranks
// started this process. Considers only the variables of mpirun, mpiexec and `srun --mpi`: the tasks of a Slurm array
// are not ranks.
std::optional<int> LaunchedRanks(const std::function<const char*(const char*)>& environment);
std::optional<int> LaunchedRanks();  // by getenv

}  // namespace albtpu
