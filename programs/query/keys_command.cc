#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "config/key_reference.h"
#include "programs/command_line/help.h"
#include "programs/command_line/standard_output.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"

namespace albtpu::programs {
namespace {

using config::ListedKey;
using nlohmann::ordered_json;

constexpr char kIntroduction[] = R"(# Keys of the survey file

A survey file is TOML and says what is known of a survey beside its points: `albtpu-query las`, `csv`, `pulse`, `plan`
and `sea` take it by `--survey FILE.toml`. A flag overrides the key of the same meaning. Paths count from the folder of
the survey file. Waves are any number of tables `[[sea.waves]]`. This page is the output of `albtpu-query keys`; a test
compares them.
)";

std::string TypeText(const ListedKey& key) {
  return absl::StrCat(key.values.type, key.values.unit.empty() ? "" : ", ", key.values.unit);
}

std::string Markdown(const std::vector<ListedKey>& keys) {
  std::string page = kIntroduction, section;
  for (const ListedKey& key : keys) {
    if (key.section != section) {
      const bool many = key.section == "sea.waves";
      absl::StrAppend(
          &page, "\n## ", many ? "[[" : "[", key.section, many ? "]]" : "]",
          "\n\n| key | type, unit | range | default | flag | meaning |\n|---|---|---|---|---|---|\n");
    }
    section = key.section;
    absl::StrAppend(&page, "| `", key.key, "` | ", TypeText(key), " | ", RangeText(key.values), " | ",
                    key.absent, " | ", key.flag.empty() ? "" : absl::StrCat("`", key.flag, "`"), " | ",
                    key.help, " |\n");
  }
  return page;
}

ordered_json Json(const std::vector<ListedKey>& keys) {
  const auto or_null = [](const std::string& text) {
    return text.empty() ? ordered_json() : ordered_json(text);
  };
  const auto limit = [](const std::optional<double>& number) {
    return number.has_value() && std::isfinite(*number) ? ordered_json(*number) : ordered_json();
  };
  ordered_json json = {{"keys", ordered_json::array()}};
  for (const ListedKey& key : keys)
    json["keys"].push_back({{"section", key.section},
                            {"key", key.key},
                            {"type", key.values.type},
                            {"unit", or_null(key.values.unit)},
                            {"least", limit(key.values.least)},
                            {"greatest", limit(key.values.greatest)},
                            {"words", key.values.words},
                            {"default", or_null(key.absent)},
                            {"flag", or_null(key.flag)},
                            {"help", key.help}});
  return json;
}

absl::Status RunKeys(bool json) {
  const std::vector<ListedKey> keys = config::ListKeys();
  std::cout << (json ? Json(keys).dump(2) + "\n" : Markdown(keys));
  return FlushStandardOutput();
}

}  // namespace

void AddKeysCommand(CLI::App& program, Run& run) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand(
      "keys", "List the keys of the survey file: type, unit, range, default, flag, meaning");
  command->add_flag("--json", *json, "Print one JSON object with an array `keys`")->group(group::kOutput);
  EndHelp(*command, "", "", "--json");
  command->callback([json, &run] { run = [json] { return RunKeys(*json); }; });
}

}  // namespace albtpu::programs
