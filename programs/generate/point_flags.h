// The flags of albtpu-generate point.
#pragma once

#include "programs/command_line/cli_fwd.h"
#include "programs/generate/commands.h"

namespace albtpu::programs {

void AddPoint(CLI::App& point, PointOptions& options, int& threads);

}  // namespace albtpu::programs
