#include "programs/query/first_contact.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "annotate/totals/plan_total.h"
#include "formats/text/text.h"
#include "programs/query/las_look.h"
#include "service/printable_text.h"

namespace albtpu::programs {
namespace {

namespace fs = std::filesystem;
using config::DraftValue;
using config::OpenDecision;
using Arguments = std::vector<std::string>;

// The answer to bad usage takes a second or two, however large the file.
constexpr std::uint64_t kPointsOfALook = 5'000'000;

// One argument, as a shell reads it.
std::string ForShell(const std::string& argument) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,:=+-@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  return absl::StrCat("'", absl::StrReplaceAll(argument, {{"'", "'\\''"}}), "'");
}

std::string CommandLine(const Arguments& arguments) {
  return absl::StrCat("albtpu-query ", absl::StrJoin(arguments, " ", [](std::string* text, const std::string& each) {
                        text->append(ForShell(each));
                      }));
}

void AppendLines(const std::string& heading, const Arguments& lines, std::string& text) {
  if (lines.empty()) return;
  absl::StrAppend(&text, heading, "\n");
  for (const std::string& line : lines) absl::StrAppend(&text, "  ", line, "\n");
}

Arguments Numbered(const std::vector<OpenDecision>& open, std::size_t first) {
  Arguments lines;
  for (const OpenDecision& decision : open)
    lines.push_back(absl::StrCat(first + lines.size(), ". ", PrintableText(decision.message)));
  return lines;
}

// FLAG [VALUE] of an example.
struct ExampleFlag {
  Arguments words;
  bool has_key = false;  // Of the survey file.
};

// Adds a flag unless it is there.
void Add(const ExampleFlag& flag, std::vector<ExampleFlag>& flags) {
  const auto name = [](const ExampleFlag& each) { return each.words.front(); };
  if (std::ranges::count(flags, flag.words.front(), name) == 0) flags.push_back(flag);
}

bool IsOpen(const std::vector<OpenDecision>& open, std::string_view section) {
  return std::ranges::count(open, section, &OpenDecision::section) > 0;
}

// The flags that close what is open.
std::vector<ExampleFlag> FlagsThatClose(const std::vector<OpenDecision>& open, const Suggestions& suggestions,
                                        const LasOptions& options, const config::SurveySettings& settings) {
  std::vector<ExampleFlag> flags;
  const bool by_angle = IsOpen(open, "trajectory") && !suggestions.from_returns;
  for (const OpenDecision& decision : open) {
    if (decision.section == "trajectory" && by_angle) {
      Add({suggestions.by_angle}, flags);
      Add({kExampleAltitude}, flags);
    } else if (decision.section == "altitude") {
      Add({kExampleAltitude}, flags);
    } else if (decision.section == "units") {
      if (!suggestions.units.empty()) Add({suggestions.units}, flags);
    } else if (const DraftValue* value = FirstOf(suggestions, decision.section)) {
      Add({FlagOf(*value), true}, flags);
    }
  }
  // A sensor of the example has a divergence.
  if (IsOpen(open, "beam size") && !IsOpen(open, "sensor")) {
    if (!options.beams.divergence.has_value()) Add({{"--divergence", "1"}}, flags);
    if (options.beams.scanner.has_value() || options.beams.incidence.has_value()) Add({kExampleAltitude}, flags);
  }
  const DraftValue* const classes = FirstOf(suggestions, "output");
  if (settings.output.classes.empty() && classes != nullptr) Add({FlagOf(*classes), true}, flags);
  return flags;
}

// What a total by these settings, with the flags of the example, would assume.
Arguments AssumedWith(const std::vector<ExampleFlag>& flags, const LasOptions& options,
                      config::SurveySettings settings) {
  for (const auto& [words, has_key] : flags) {
    if (!has_key) continue;
    const config::FlagKey key = config::FindFlag(words.front());
    const absl::StatusOr<config::Value> value = ParseValue(*key.declaration, words.size() > 1 ? words[1] : "");
    if (value.ok()) key.put(*value, settings);
  }
  if (!settings.wants_total()) return {};
  const absl::StatusOr<annotate::TotalPlan> plan = annotate::PlanTotal(
      settings, {.has_surface_returns = !settings.surface.classes.empty(),
                 .has_level = settings.surface.level.has_value(),
                 .trajectory_errors = settings.trajectory.errors.empty() ? "" : "--trajectory-errors"});
  if (!plan.ok()) return {};
  Arguments lines = annotate::Assumptions(*plan);
  if (!options.beams.divergence.has_value() && plan->divergence.has_value()) {
    const annotate::StatedNumber number = annotate::AssumedDivergence(*plan->divergence);
    lines.push_back(absl::StrCat(number.name, " ", number.value, " (", number.source, ")"));
  }
  return lines;
}

}  // namespace

absl::Status Refuse(const FirstContact& contact) {
  std::string text;
  for (const std::string& line : contact.found) absl::StrAppend(&text, line, "\n");
  AppendLines("To be decided:", Numbered(contact.open, 1), text);
  AppendLines("And for totals; without a sensor, only the contribution of the sea surface is given:",
              Numbered(contact.of_total, contact.open.size() + 1), text);
  AppendLines("Assumed where nothing else is given:", contact.assumed, text);
  AppendLines("For example, with the numbers of your survey in place of these:", {CommandLine(contact.example)}, text);
  if (!contact.remedy.empty())
    AppendLines("Or begin a file of all settings:", {CommandLine(contact.remedy) + " > survey.toml"}, text);
  std::fputs(text.c_str(), stderr);
  return formats::UsageError(absl::StrCat(
      contact.command, ": ", contact.open.size() + contact.of_total.size(), " decisions are missing (listed above); ",
      contact.remedy.empty() ? "give them by flags or in the file"
                             : "give them by flags, or in a survey file (albtpu-query init)"));
}

std::vector<std::string> GivenArguments(const CLI::App& command) {
  Arguments words = {command.get_name()}, flags;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (option->get_lnames().empty()) {
      words.insert(words.end(), option->results().begin(), option->results().end());
      continue;
    }
    const std::string name = "--" + option->get_lnames().front();
    for (const std::string& result : option->results()) {
      flags.push_back(name);
      if (option->get_items_expected_max() > 0) flags.push_back(result);
    }
  }
  words.insert(words.end(), flags.begin(), flags.end());
  return words;
}

std::string ExampleOutput(const std::string& input) {
  const fs::path path(input);
  return absl::StrCat(path.stem().string(), "_tpu", path.extension().string());
}

FirstContact ContactOf(const LasOptions& options, const config::SurveySettings& settings,
                       std::vector<OpenDecision> open, const std::vector<std::string>& given) {
  FirstContact contact{.command = "las", .open = std::move(open), .example = given};
  const std::string& input = options.files.files.front();
  if (!settings.wants_total()) {
    contact.of_total.push_back({"sensor", "no sensor is named; give --sensor NAME (albtpu-query sensors lists them)"});
    for (OpenDecision& decision : annotate::UndecidedOf(settings)) contact.of_total.push_back(std::move(decision));
  }
  if (IsOutputMissing(options.files)) {
    contact.open.insert(contact.open.begin(), MissingOutput(".las"));
    contact.example.insert(contact.example.begin() + 2, ExampleOutput(input));
  }
  std::error_code unknown;
  if (fs::is_directory(input, unknown)) return contact;
  contact.remedy = {"init", input};
  const absl::StatusOr<LasLook> look = LookAt(input, kPointsOfALook);
  if (!look.ok()) {
    contact.found = {PrintableText(std::string(look.status().message()))};
    return contact;
  }
  contact.found = FoundLines(*look);
  if (!look->units_message.empty() && !options.beams.metres_per_unit.has_value())
    contact.open.push_back({"units", look->units_message});
  const absl::StatusOr<Suggestions> suggestions = SuggestionsFor(std::span(&*look, 1));
  if (!suggestions.ok()) return contact;
  std::vector<OpenDecision> all = contact.open;
  if (FirstOf(*suggestions, "sensor") != nullptr)
    all.insert(all.end(), contact.of_total.begin(), contact.of_total.end());
  const std::vector<ExampleFlag> flags = FlagsThatClose(all, *suggestions, options, settings);
  for (const ExampleFlag& flag : flags)
    if (std::ranges::count(contact.example, flag.words.front()) == 0)
      contact.example.insert(contact.example.end(), flag.words.begin(), flag.words.end());
  contact.assumed = AssumedWith(flags, options, settings);
  return contact;
}

bool IsOutputMissing(const annotate::FileOptions& files) {
  return files.files.size() == 1 && files.output_folder.empty();
}

OpenDecision MissingOutput(const std::string& extension) {
  return {"output file", absl::StrCat("the output is missing; give IN", extension, " OUT", extension,
                                      ", or --output-dir DIR and any number of inputs")};
}

}  // namespace albtpu::programs
