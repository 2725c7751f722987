#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "annotate/run/exit_status.h"
#include "programs/command_line/help.h"
#include "programs/command_line/standard_output.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "service/client/server_health.h"

namespace albtpu::programs {
namespace {

absl::Status RunHealth(const SourceOptions& options) {
  const absl::Status status = client::CheckHealth(options.server, options.credentials);
  if (!status.ok()) return status;
  std::cout << "SERVING\n";
  return FlushStandardOutput();
}

}  // namespace

void AddHealthCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SourceOptions>();
  CLI::App* command = program.add_subcommand("health", "Check whether a service is serving");
  AddServerOptions(*command, *options)->required();
  EndHelp(*command, "Exit code: 0 if the service is serving, 2 for bad usage, 1 otherwise.",
          "--server 127.0.0.1:50051", "--server lidar.example:50051 --tls-ca ca.pem --token-file token");
  command->callback([options, &run] { run = [options] { return RunHealth(*options); }; });
}

}  // namespace albtpu::programs
