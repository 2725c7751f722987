// The flags of albtpu-generate water-point.
#pragma once

#include "programs/command_line/cli_fwd.h"
#include "programs/generate/commands.h"

namespace albtpu::programs {

void AddWaterPoint(CLI::App& point, WaterPointOptions& options, int& threads);

}  // namespace albtpu::programs
