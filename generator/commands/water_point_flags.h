// The flags of albtpu-generate water-point.
#pragma once

#include "command_line/cli_fwd.h"
#include "generator/commands/commands.h"

namespace albtpu {

void AddWaterPoint(CLI::App& point, WaterPointOptions& options, int& threads);

}  // namespace albtpu
