// The commands of albtpu-query about whole surveys. Each adds its options to the program and sets `run` if it is the
// command given.
#pragma once

#include <functional>

#include "absl/status/status.h"
#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

void AddReportCommand(CLI::App& program, std::function<absl::Status()>& run);
void AddCrossCheckCommand(CLI::App& program, std::function<absl::Status()>& run);

}  // namespace albtpu::programs
