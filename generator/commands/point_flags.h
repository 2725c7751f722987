// The flags of albtpu-generate point.
#pragma once

#include "command_line/cli_fwd.h"
#include "generator/commands/commands.h"

namespace albtpu {

void AddPoint(CLI::App& point, PointOptions& options, int& threads);

}  // namespace albtpu
