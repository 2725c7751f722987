#include <iostream>
#include <memory>

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
  return FlushAnswers();
}

}  // namespace

void AddHealthCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SourceOptions>();
  CLI::App* command =
      program.add_subcommand("health", "Ask a service whether it serves: exit 0 if so, else 1");
  AddServerOptions(*command, *options)->required();
  command->footer("Exit: 0 when it serves, 2 for bad usage, 1 otherwise.");
  command->callback([options, &run] { run = [options] { return RunHealth(*options); }; });
}

}  // namespace albtpu::client
