// The flags of the commands point and water-point of albtpu-generate, and those of more than one command.
#pragma once

#include "programs/command_line/cli_fwd.h"
#include "programs/generate/commands.h"

namespace albtpu::programs {

// Flags of more than one command of albtpu-generate.

// The heading of --help under which options of the computation stand.
inline constexpr char kWork[] = "The computation";

// A finite number in a range that includes both ends. CLI11 parses "nan" and "inf" as numbers.
CLI::Validator NumberIn(double least, double most);

// A seed of random numbers.
CLI::Validator Seed();

void AddThreads(CLI::App& command, int& threads);

// The flags of albtpu-generate water-point.

void AddWaterPoint(CLI::App& point, WaterPointOptions& options, int& threads);

void AddPoint(CLI::App& point, PointOptions& options, int& threads);

}  // namespace albtpu::programs
