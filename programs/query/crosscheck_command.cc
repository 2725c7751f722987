#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "programs/command_line/checks.h"
#include "programs/command_line/help.h"
#include "programs/command_line/standard_output.h"
#include "programs/query/report_commands.h"
#include "quality/crosscheck/overlap_check.h"

namespace albtpu::programs {
namespace {

struct CrossCheckOptions {
  std::string annotated;
  double patch = quality::kDefaultPatch;
  bool json = false;
};

absl::Status RunCrossCheck(const CrossCheckOptions& options) {
  const absl::StatusOr<std::vector<quality::AnnotatedLasFile>> files =
      quality::OpenAnnotated(options.annotated);
  if (!files.ok()) return files.status();
  const absl::StatusOr<quality::CrossCheck> check = quality::CrossCheckOf(*files, options.patch);
  if (!check.ok()) return check.status();
  std::cout << (options.json ? quality::CrossCheckJson(*check).dump(2) + "\n"
                             : quality::CrossCheckText(*check));
  return FlushStandardOutput();
}

}  // namespace

void AddCrossCheckCommand(CLI::App& program, std::function<absl::Status()>& run) {
  const auto options = std::make_shared<CrossCheckOptions>();
  CLI::App* command = program.add_subcommand(
      "crosscheck", "Whether the predicted uncertainty explains the differences between overlapping lines");
  command
      ->add_option("OUT_DIR", options->annotated,
                   "Folder that albtpu-query las --details wrote, or a file in it")
      ->required();
  command->add_option("--patch", options->patch, "Side of the patches in which lines are compared [m]")
      ->check(NumberIn(0.5, 100, "m"))
      ->capture_default_str();
  command->add_flag("--json", options->json, "JSON, with every band and every two lines");
  Group(*command, "How points are gathered", {"--patch"});
  Group(*command, "Output", {"--json"});
  EndHelp(*command, "Lines are distinguished by the point source ID.", "annotated",
          "annotated --patch 3 --json");
  command->callback([options, &run] { run = [options] { return RunCrossCheck(*options); }; });
}

}  // namespace albtpu::programs
