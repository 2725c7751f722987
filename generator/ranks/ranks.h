// The ranks of one program that `mpirun` started, and messages between them. A build without MPI knows one
// rank.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu {

class Ranks {
 public:
  struct Message {
    int rank;  // from which
    int tag;   // what of, as the sender says
    std::string bytes;
  };

  // Joins the ranks that were started with this one; alone where there are none. FailedPrecondition when a
  // launcher started several that this build cannot join. To be called once.
  static absl::StatusOr<std::unique_ptr<Ranks>> Join();

  Ranks() = default;
  virtual ~Ranks() = default;  // leaves; returns when all ranks do
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const = 0;  // from 0
  virtual int size() const = 0;

  // One thread at a time may be in one of these.
  virtual void Send(int rank, int tag, const std::string& bytes) = 0;
  virtual std::optional<Message> Poll() = 0;  // a message that has come, from any rank

  // Waits for a message, without keeping a core busy.
  Message Receive();

  // Ends all ranks, now, with exit status 1.
  [[noreturn]] virtual void EndAll() = 0;
};

// This process alone.
std::unique_ptr<Ranks> OneRank();

}  // namespace albtpu
