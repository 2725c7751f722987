// Ranks by MPI. No other file includes mpi.h.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <cstdlib>

#include "absl/strings/str_cat.h"
#include "generator/ranks/ranks.h"

namespace albtpu {
namespace {

// Errors within MPI end all ranks, which is MPI's default.
class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    serialized_ = provided >= MPI_THREAD_SERIALIZED;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override { MPI_Finalize(); }

  bool serialized() const { return serialized_; }
  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void Send(int rank, int tag, const std::string& bytes) override {
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
  }

  std::optional<Message> Poll() override {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (!there) return std::nullopt;
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(count), '\0')};
    MPI_Recv(message.bytes.data(), count, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
  }

  [[noreturn]] void EndAll() override {
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    std::abort();  // MPI_Abort does not return
  }

 private:
  bool serialized_ = false;
  int rank_ = 0, size_ = 1;
};

}  // namespace

absl::StatusOr<std::unique_ptr<Ranks>> Ranks::Join() {
  const std::optional<int> launched = LaunchedRanks();
  // Without a launcher, MPI is not started: it would need a daemon, which some machines forbid.
  if (!launched) return OneRank();
  auto ranks = std::make_unique<MpiRanks>();
  if (ranks->size() < *launched) {
    return absl::FailedPreconditionError(
        absl::StrCat("started as one of ", *launched, " ranks, but its MPI sees ", ranks->size(),
                     " (another MPI's mpirun); start it with the mpirun of the MPI that it was built with, or give "
                     "each process its share with --shard"));
  }
  if (ranks->size() > 1 && !ranks->serialized()) {
    return absl::FailedPreconditionError(
        "this MPI does not let several threads send messages (no MPI_THREAD_SERIALIZED); use --shard");
  }
  return ranks;
}

}  // namespace albtpu
