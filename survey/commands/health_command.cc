#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "command_line/help.h"
#include "command_line/standard_output.h"
#include "service/client/server_health.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"
#include "survey/exit_status.h"

namespace albtpu::client {
namespace {

absl::Status RunHealth(const SourceOptions& options) {
  const absl::Status status = CheckHealth(options.server, options.credentials);
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

}  // namespace albtpu::client
