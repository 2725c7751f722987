// The ranks of one program started by `mpirun`, and messages between them. A build without MPI has one rank.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu {

class Ranks {
 public:
  struct Message {
    int rank;  // of the sender
    int tag;   // the kind of message, chosen by the sender
    std::string bytes;
  };

  // Joins the ranks of the launcher that started this process; one rank where there are no others. FailedPrecondition
  // when a launcher started several ranks that this build cannot join. Call it once.
  static absl::StatusOr<std::unique_ptr<Ranks>> Join();

  Ranks() = default;
  virtual ~Ranks() = default;  // leaves the ranks, and waits until all of them leave
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const = 0;  // from 0
  virtual int size() const = 0;

  // Only one thread at a time may call Send, Poll or Receive.
  virtual void Send(int rank, int tag, const std::string& bytes) = 0;
  virtual std::optional<Message> Poll() = 0;  // a message that has arrived, from any rank

  // Waits for a message without keeping a core busy.
  Message Receive();

  // Ends all ranks immediately with exit status 1.
  [[noreturn]] virtual void EndAll() = 0;
};

// This process as the only rank.
std::unique_ptr<Ranks> OneRank();

// Detects from the environment whether a launcher started this process as one of several ranks of one program.

// The number of ranks, or a lower bound where the launcher does not state it; nullopt where no launcher of ranks
// started this process. Considers only the variables of mpirun, mpiexec and `srun --mpi`: the tasks of a Slurm array
// are not ranks.
std::optional<int> LaunchedRanks(const std::function<const char*(const char*)>& environment);
std::optional<int> LaunchedRanks();  // by getenv

}  // namespace albtpu
