// albtpu-query: the uncertainty of single pulses, of CSV files and of LAS and LAZ files.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "annotate/run/file_progress.h"
#include "programs/command_line/command_line.h"
#include "programs/command_line/manual.h"
#include "programs/query/commands.h"
#include "tables/default_tables.h"
#include "tables/file/table_folder.h"
#include "tables/version.h"

namespace albtpu::programs {
namespace {

int Main(int argc, char** argv) {
  CLI::App program("Per-pulse total propagated uncertainty of airborne lidar bathymetry");
  program.name("albtpu-query");
  program.require_subcommand(1);
  SetUpProgram(program, Version(), Commit(), [] { return DigestsText(DefaultTablesDirectory()); });
  AddManualFlags(program, std::string(Version()));
  EndHelp(program, absl::StrCat("albtpu-query COMMAND --help lists the options of a command.\n", kWhereAnswersComeFrom),
          "pulse --wind-speed 7 --incidence 12 --footprint 0.5 --depth 8",
          "las line.las with_uncertainty.las --trajectory sbet.out --water-classes 41 --wind-speed 5 "
          "--divergence 1");
  Run run;
  AddInitCommand(program, run);
  AddPulseCommand(program, run);
  AddCsvCommand(program, run);
  AddLasCommand(program, run);
  AddPlanCommand(program, run);
  AddReportCommand(program, run);
  AddSurfaceCommand(program, run);
  AddCrossCheckCommand(program, run);
  AddCheckPointsCommand(program, run);
  AddTrajectoryCommand(program, run);
  AddSeaCommand(program, run);
  AddSensorsCommand(program, run);
  AddKeysCommand(program, run);
  AddTablesCommand(program, run);
  AddHealthCommand(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    program.exit(help, std::cout, std::cerr);
    return annotate::Report(FlushText());
  } catch (const CLI::ParseError& error) {
    return annotate::Report(formats::UsageError(UsageMessage(program, error)));
  }
  return annotate::Report(run());
}

}  // namespace
}  // namespace albtpu::programs

int main(int argc, char** argv) {
  // A file that reaches the size limit of the process makes write() fail instead of ending the program.
  std::signal(SIGXFSZ, SIG_IGN);
  // Debian's Abseil searches for lock cycles at every lock that gRPC takes.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  // A closed standard error does not end the work; a closed standard output makes writing answers fail.
  std::signal(SIGPIPE, SIG_IGN);
  // gRPC's log repeats its errors; GRPC_VERBOSITY in the environment turns it on.
  setenv("GRPC_VERBOSITY", "NONE", 0);
  try {
    return albtpu::programs::Main(argc, argv);
  } catch (const std::exception& error) {
    return albtpu::annotate::Report(absl::InternalError(absl::StrCat(error.what(), "; please report this")));
  }
}
