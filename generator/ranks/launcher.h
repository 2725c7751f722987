// Whether this process was started as one of several ranks of one program, by what launchers leave in the
// environment.
#pragma once

#include <functional>
#include <optional>

namespace albtpu {

// Nullopt where no launcher of ranks started this process; else their number, or the least that it can be
// where the launcher does not tell. Only what mpirun, mpiexec and `srun --mpi` set counts: the tasks of a
// Slurm array are no ranks.
std::optional<int> LaunchedRanks(const std::function<const char*(const char*)>& environment);
std::optional<int> LaunchedRanks();  // by getenv

}  // namespace albtpu
