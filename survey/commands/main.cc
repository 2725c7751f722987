// albtpu-query: asks for the uncertainty of pulses, of CSV files and of LAS files. Flags, then a command.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "survey/commands/commands.h"
#include "survey/exit_status.h"
#include "tables/version.h"

namespace {

int Main(int argc, char** argv) {
  using namespace albtpu::client;

  CLI::App program("Uncertainty of airborne lidar bathymetry by the sea surface, pulse by pulse");
  program.name("albtpu-query");
  program.require_subcommand(1);
  program.set_version_flag("--version", absl::StrCat("albtpu-query ", std::string(albtpu::Version()), " (",
                                                     std::string(albtpu::Commit()), ")"));
  program.footer(
      "Neither --server nor --table: the installed tables answer, in this process; ALBTPU_TABLES names "
      "another folder.\nExit: 0 when every pulse got an outcome, 2 for bad usage, 1 for failure.");
  Run run;
  AddPulseCommand(program, run);
  AddCsvCommand(program, run);
  AddLasCommand(program, run);
  AddTablesCommand(program, run);
  AddHealthCommand(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    program.exit(help, std::cout, std::cerr);
    return Report(FlushAnswers());
  } catch (const CLI::ValidationError& error) {  // Ours: they say what would be right.
    return Report(UsageError(error.what()));
  } catch (const CLI::ParseError& error) {
    return Report(UsageError(absl::StrCat(error.what(), ": see albtpu-query --help, or COMMAND --help")));
  }
  return Report(run());
}

}  // namespace

int main(int argc, char** argv) {
  // A file grown past its limit is an error of write(), not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  // Debian's Abseil looks for cycles of locks at every lock that gRPC takes.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  // Work does not end because nobody reads its messages; answers that nobody reads are an error of writing.
  std::signal(SIGPIPE, SIG_IGN);
  setenv("GRPC_VERBOSITY", "NONE", 0);  // What gRPC logs is in its errors too; who wants both says so.
  try {
    return Main(argc, argv);
  } catch (const std::exception& error) {
    return albtpu::client::Report(absl::InternalError(absl::StrCat(error.what(), ": please report this")));
  }
}
