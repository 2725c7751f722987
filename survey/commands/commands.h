// The commands of albtpu-query. Each adds its flags to the program and, when it is the one that was given,
// sets `run`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "absl/status/status.h"

namespace albtpu::client {

using Run = std::function<absl::Status()>;

void AddPulseCommand(CLI::App& program, Run& run);
void AddCsvCommand(CLI::App& program, Run& run);
void AddLasCommand(CLI::App& program, Run& run);
void AddTablesCommand(CLI::App& program, Run& run);
void AddHealthCommand(CLI::App& program, Run& run);

}  // namespace albtpu::client
