#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "command_line/help.h"
#include "command_line/standard_output.h"
#include "config/key_reference.h"
#include "survey/commands/commands.h"
#include "survey/commands/options.h"

namespace albtpu::client {
namespace {

using config::ListedKey;
using nlohmann::ordered_json;

struct KeysOptions {
  bool json = false, markdown = false;
};

constexpr char kIntroduction[] = R"(# Keys of the survey file

A survey file is TOML and says what is known of a survey beside its points: `albtpu-query las`, `csv`, `pulse`, `plan` and
`sea` take it by `--survey FILE.toml`. A flag overrides the key of the same meaning. Paths count from the folder of the
survey file. Waves are any number of tables `[[sea.waves]]`. This page is the output of `albtpu-query keys --markdown`; a
test compares them.
)";

std::string TypeText(const ListedKey& key) {
  return absl::StrCat(key.values.type, key.values.unit.empty() ? "" : ", ", key.values.unit);
}

std::string Heading(const std::string& section) {
  return section == "sea.waves" ? "[[sea.waves]]" : absl::StrCat("[", section, "]");
}

std::string Markdown(const std::vector<ListedKey>& keys) {
  std::string page = kIntroduction, section;
  for (const ListedKey& key : keys) {
    if (key.section != section)
      absl::StrAppend(
          &page, "\n## ", Heading(key.section),
          "\n\n| key | type, unit | range | default | flag | meaning |\n|---|---|---|---|---|---|\n");
    section = key.section;
    absl::StrAppend(&page, "| `", key.key, "` | ", TypeText(key), " | ", RangeText(key.values), " | ",
                    key.absent, " | ", key.flag.empty() ? "" : absl::StrCat("`", key.flag, "`"), " | ",
                    key.help, " |\n");
  }
  return page;
}

std::string PlainText(const std::vector<ListedKey>& keys) {
  std::string text, section;
  for (const ListedKey& key : keys) {
    if (key.section != section)
      absl::StrAppend(&text, section.empty() ? "" : "\n", Heading(key.section), "\n");
    section = key.section;
    const std::string range = RangeText(key.values);
    absl::StrAppend(&text, "  ", key.key, ": ", TypeText(key), range.empty() ? "" : ": ", range,
                    key.flag.empty() ? "" : absl::StrCat("; ", key.flag), "\n      ", key.help,
                    key.absent.empty() ? "" : absl::StrCat(" (default: ", key.absent, ")"), "\n");
  }
  return text;
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

absl::Status RunKeys(const KeysOptions& options) {
  const std::vector<ListedKey> keys = config::ListKeys();
  std::cout << (options.markdown ? Markdown(keys)
                : options.json   ? Json(keys).dump(2) + "\n"
                                 : PlainText(keys));
  return FlushStandardOutput();
}

}  // namespace

void AddKeysCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<KeysOptions>();
  CLI::App* command = program.add_subcommand(
      "keys", "List the keys of the survey file: type, unit, range, default, flag, meaning");
  CLI::Option* json = command->add_flag("--json", options->json, "Print one JSON object with an array `keys`")
                          ->group(group::kOutput);
  command->add_flag("--markdown", options->markdown, "Print the page docs/survey.md")
      ->excludes(json)
      ->group(group::kOutput);
  EndHelp(*command, "", "", "--json");
  command->callback([options, &run] { run = [options] { return RunKeys(*options); }; });
}

}  // namespace albtpu::client
