// The commands of albtpu-query. Each adds its options to the program and sets `run` if it is the command given.
#pragma once

#include <functional>

#include "absl/status/status.h"
#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

inline constexpr char kWhereAnswersComeFrom[] =
    "Without --server and --table, the default one of the installed tables answers, in this process. The\n"
    "environment variable ALBTPU_TABLES names another folder of tables.\n"
    "Exit code: 0 if every pulse got an outcome, and of the pulses in files at least half a number, 2 for "
    "bad\n"
    "usage, 1 for a failure.";

using Run = std::function<absl::Status()>;

void AddPulseCommand(CLI::App& program, Run& run);
void AddCsvCommand(CLI::App& program, Run& run);
void AddLasCommand(CLI::App& program, Run& run);
void AddPlanCommand(CLI::App& program, Run& run);
void AddTrajectoryCommand(CLI::App& program, Run& run);
void AddSeaCommand(CLI::App& program, Run& run);
void AddSensorsCommand(CLI::App& program, Run& run);
void AddKeysCommand(CLI::App& program, Run& run);
void AddTablesCommand(CLI::App& program, Run& run);
void AddInitCommand(CLI::App& program, Run& run);
void AddHealthCommand(CLI::App& program, Run& run);
void AddReportCommand(CLI::App& program, Run& run);
void AddCrossCheckCommand(CLI::App& program, Run& run);
void AddCheckPointsCommand(CLI::App& program, Run& run);
void AddSurfaceCommand(CLI::App& program, Run& run);

}  // namespace albtpu::programs
