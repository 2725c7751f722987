#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/run/file_progress.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "service/client/channel.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

std::string Text(const client::TableSummary& table) {
  std::string text = absl::StrCat(PrintableText(table.name.empty() ? table.id : table.name),
                                  table.is_default ? " (default)" : "", "\n");
  const auto line = [&text](std::string_view label, const std::string& value) {
    absl::StrAppend(&text, absl::StrFormat("  %-24s %s\n", PrintableText(label), PrintableText(value)));
  };
  line("title", table.title);
  line("id", table.id);
  line("version", table.version);
  line("digest", table.digest);
  for (const AxisId id : kAxes) {
    const client::AxisRange& range = table.axes[Index(id)];
    line(Describe(id).name,
         absl::StrFormat("%g to %g %s, %d %s", range.first, range.last, std::string(Describe(id).units), range.nodes,
                         range.nodes == 1 ? "node" : "nodes"));
  }
  for (const auto& [name, value] : table.attributes) line(name, value);
  return text;
}

nlohmann::ordered_json JsonOf(const client::TableSummary& table) {
  nlohmann::ordered_json json = {{"name", table.name},
                                 {"default", table.is_default},
                                 {"title", table.title},
                                 {"id", table.id},
                                 {"version", table.version},
                                 {"digest", table.digest},
                                 {"axes", nlohmann::json::array()},
                                 {"attributes", table.attributes}};
  for (const AxisId id : kAxes) {
    const client::AxisRange& range = table.axes[Index(id)];
    json["axes"].push_back({{"name", Describe(id).name},
                            {"unit", Describe(id).units},
                            {"first", range.first},
                            {"last", range.last},
                            {"nodes", range.nodes}});
  }
  return json;
}

absl::Status RunTables(const SourceOptions& options, bool as_json) {
  ASSIGN_OR_RETURN(const std::vector<client::TableSummary> tables, ListTables(options));
  if (as_json) {
    nlohmann::ordered_json json = {{"tables", nlohmann::json::array()}};
    for (const client::TableSummary& table : tables) json["tables"].push_back(JsonOf(table));
    std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    return FlushStandardOutput();
  }
  for (std::size_t i = 0; i < tables.size(); ++i) std::cout << (i > 0 ? "\n" : "") << Text(tables[i]);
  if (tables.empty()) annotate::Note("there are no tables; make one with albtpu-generate, or name a file with --table");
  return FlushStandardOutput();
}

absl::Status RunHealth(const SourceOptions& options, bool as_json) {
  RETURN_IF_ERROR(client::CheckHealth(options.server, options.credentials));
  std::cout << (as_json ? "{\n  \"status\": \"SERVING\"\n}\n" : "SERVING\n");
  return FlushStandardOutput();
}

}  // namespace

void AddTablesCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SourceOptions>();
  CLI::App* command =
      program.add_subcommand("tables", "List the tables with their names, ranges, digests and provenance");
  AddSourceOptions(*command, *options);
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print one JSON object with an array `tables`")->group(group::kOutput);
  EndHelp(*command,
          "Without --server and --table, lists the installed tables, or those in the folder that the\n"
          "environment variable ALBTPU_TABLES names.",
          "--table-name survey", "--server 127.0.0.1:50051 --json");
  command->callback([options, json, &run] { run = [options, json] { return RunTables(*options, *json); }; });
}

void AddHealthCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SourceOptions>();
  CLI::App* command = program.add_subcommand("health", "Check whether a service is serving");
  AddServerOptions(*command, *options)->required();
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print one JSON object")->group(group::kOutput);
  EndHelp(*command, "Exit code: 0 if the service is serving, 2 for bad usage, 1 otherwise.", "--server 127.0.0.1:50051",
          "--server lidar.example:50051 --tls-ca ca.pem --token-file token");
  command->callback([options, json, &run] { run = [options, json] { return RunHealth(*options, *json); }; });
}

}  // namespace albtpu::programs
