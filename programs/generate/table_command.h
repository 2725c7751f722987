// What commands share that make a table: the progress of a long computation, and the file that is written.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

#include "absl/status/status.h"
#include "tables/table.h"

namespace albtpu::programs {

// The progress of a long computation and the time left, on standard error.

// On a terminal a bar, which is redrawn in place and erased at the end; elsewhere a line every ten seconds.
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Reach(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, last_shown_;
};

// The table file that a command writes.

// Checks, before the computation, that the table can be written.
absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite);

// Writes the table. Prints its id, version, digest and interpolation errors on standard output, and a warning on
// standard error if they are large.
absl::Status Publish(const Table& table, const std::filesystem::path& output, bool overwrite);

}  // namespace albtpu::programs
