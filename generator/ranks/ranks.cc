#include "generator/ranks/ranks.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <utility>

namespace albtpu {
namespace {

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void Send(int, int, const std::string&) override { assert(false && "there is no other rank"); }
  std::optional<Message> Poll() override { return std::nullopt; }
  [[noreturn]] void EndAll() override { std::exit(EXIT_FAILURE); }
};

}  // namespace

Ranks::Message Ranks::Receive() {
  for (;;) {
    if (std::optional<Message> message = Poll()) return *std::move(message);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

std::unique_ptr<Ranks> OneRank() { return std::make_unique<Alone>(); }

std::optional<int> LaunchedRanks(const std::function<const char*(const char*)>& environment) {
  const auto number = [&](const char* name) -> std::optional<int> {
    const char* text = environment(name);
    if (text == nullptr) return std::nullopt;
    const std::string_view digits(text);
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() ? std::optional<int>(value) : std::nullopt;
  };
  // Set by Open MPI's mpirun; by MPICH's, Intel's and `srun --mpi=pmi2`.
  for (const char* size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const std::optional<int> ranks = number(size)) return ranks;
  // `srun --mpi=pmix` sets only the number of each rank; Slurm sets the number of tasks of the job step.
  if (const std::optional<int> rank = number("PMIX_RANK"))
    return std::max(*rank + 1, number("SLURM_STEP_NUM_TASKS").value_or(1));
  return std::nullopt;
}

std::optional<int> LaunchedRanks() {
  return LaunchedRanks([](const char* name) { return std::getenv(name); });
}

}  // namespace albtpu
