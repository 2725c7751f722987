#include "programs/query/first_contact.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/strip.h"
#include "annotate/totals/plan_total.h"
#include "formats/text/text.h"
#include "programs/query/las_look.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

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

void AppendLines(const std::string& heading, const Arguments& lines, std::string& text) {
  if (lines.empty()) return;
  absl::StrAppend(&text, heading, "\n");
  for (const std::string& line : lines) absl::StrAppend(&text, "  ", PrintableText(line), "\n");
}

Arguments Numbered(const std::vector<OpenDecision>& open, std::size_t first) {
  Arguments lines;
  for (const OpenDecision& decision : open) lines.push_back(absl::StrCat(first + lines.size(), ". ", decision.message));
  return lines;
}

// The options that `arguments` of `las` give. False where it does not take them.
bool ParseLas(const Arguments& arguments, LasOptions& options) {
  CLI::App command;
  AddLasOptions(command, options);
  try {
    command.parse(Arguments(arguments.rbegin(), arguments.rend() - 1));  // In reverse, without "las".
  } catch (const CLI::ParseError&) {
    return false;
  }
  return true;
}

// The flags that say where each beam went, by one of the ways that contradict none of the given flags.
Arguments WayOf(const Suggestions& suggestions, const LasOptions& options) {
  std::vector<Arguments> ways = {suggestions.by_angle, kExampleScanner, kExampleIncidence};
  for (const DraftValue& value : suggestions.values)
    if (value.section == "trajectory")
      ways.insert(value.key == "from_returns" ? ways.begin() : ways.end(), config::FlagOf(value));
  for (const Arguments& way : ways)
    if (GoesWith(way.front(), options.beams, options.flags.settings)) return way;
  return {};
}

// The flag that closes a decision, with its value; empty: none does.
Arguments FlagThatCloses(const OpenDecision& decision, const Suggestions& suggestions, const LasOptions& options) {
  if (decision.section == "trajectory") return WayOf(suggestions, options);
  if (decision.section == "units") return suggestions.units;
  if (decision.section == "beam size" && !options.beams.divergence.has_value()) return {"--divergence", "1"};
  if (decision.section == "beam size" || decision.section == kExampleAltitude.front()) return kExampleAltitude;
  if (decision.section.starts_with("--")) return {decision.section, "0"};
  const DraftValue* const value = FirstOf(suggestions, decision.section);
  return value != nullptr ? config::FlagOf(*value) : Arguments();
}

// What the options leave open once there is a sensor, the size of the beam last: the sensor may say it.
absl::StatusOr<std::vector<OpenDecision>> OpenOfExample(const LasOptions& options,
                                                        const config::SurveySettings& settings, const LasLook& look,
                                                        const Suggestions& suggestions) {
  ASSIGN_OR_RETURN(std::vector<OpenDecision> open, OpenDecisionsOf(options, settings));
  if (!settings.wants_total() && FirstOf(suggestions, "sensor") != nullptr) open.push_back({"sensor", ""});
  if (!look.units_message.empty() && !options.beams.metres_per_unit.has_value()) open.push_back({"units", ""});
  if (settings.output.classes.empty() && FirstOf(suggestions, "output") != nullptr) open.push_back({"output", ""});
  std::stable_partition(open.begin(), open.end(), [](const OpenDecision& each) { return each.section != "beam size"; });
  return open;
}

// Adds to the example of `contact` what closes all that is open, one flag after the other, and what it assumes. Where
// flags alone cannot, or the given ones contradict each other, there is no example.
absl::Status CompleteExample(const LasLook& look, const Suggestions& suggestions, FirstContact& contact) {
  while (true) {
    LasOptions options;
    if (!ParseLas(contact.example, options)) break;
    ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options));
    ASSIGN_OR_RETURN(const std::vector<OpenDecision> open, OpenOfExample(options, settings, look, suggestions));
    if (open.empty()) {
      const absl::StatusOr<annotate::LasAnnotation> annotation = Annotation(options, settings);
      absl::Status status = annotation.status();
      if (status.ok()) status = OutputKind(options).status();
      if (status.ok()) {
        if (annotation->total.has_value()) contact.assumed = annotate::Assumptions(*annotation->total);
        return absl::OkStatus();
      }
      contact.open.push_back({"", std::string(absl::StripPrefix(status.message(), contact.command + ": "))});
      break;
    }
    Arguments flag;
    for (auto each = open.begin(); flag.empty() && each != open.end(); ++each)
      flag = FlagThatCloses(*each, suggestions, options);
    if (flag.empty() || std::ranges::count(contact.example, flag.front()) > 0) break;
    contact.example.insert(contact.example.end(), flag.begin(), flag.end());
  }
  contact.example.clear();
  return absl::OkStatus();
}

}  // namespace

absl::Status Refuse(const FirstContact& contact) {
  std::string text;
  for (const std::string& line : contact.found) absl::StrAppend(&text, line, "\n");
  AppendLines("To be decided:", Numbered(contact.open, 1), text);
  AppendLines("And for totals; without a sensor, only the contribution of the sea surface is given:",
              Numbered(contact.of_total, contact.open.size() + 1), text);
  AppendLines("Assumed where nothing else is given:", contact.assumed, text);
  if (!contact.example.empty())
    AppendLines("For example, with the numbers of your survey in place of these:", {CommandLine(contact.example)},
                text);
  if (!contact.remedy.empty())
    AppendLines("Or begin a file of all settings:", {CommandLine(contact.remedy) + " > survey.toml"}, text);
  std::fputs(text.c_str(), stderr);
  return formats::UsageError(absl::StrCat(
      contact.command, ": ", contact.open.size() + contact.of_total.size(), " decisions are missing (listed above); ",
      contact.remedy.empty() ? "give them by flags or in the file"
                             : "give them by flags, or in a survey file (albtpu-query init)"));
}

std::string CommandLine(const Arguments& arguments) {
  return absl::StrCat("albtpu-query ", absl::StrJoin(arguments, " ", [](std::string* text, const std::string& each) {
                        text->append(ForShell(each));
                      }));
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

std::string ExampleOutput(const std::string& input, const std::string& extension) {
  const fs::path path(input);
  return absl::StrCat(path.stem().string(), "_tpu", extension.empty() ? path.extension().string() : extension);
}

void AddMissingOutput(const annotate::FileOptions& files, const std::string& extension, FirstContact& contact) {
  if (!annotate::IsOutputMissing(files)) return;
  contact.open.insert(contact.open.begin(),
                      {"output file", absl::StrCat("the output is missing; ", annotate::OutputAdvice(extension))});
  const std::string& input = files.files.front();
  std::error_code unknown;
  Arguments& example = contact.example;  // COMMAND FILES..., then flags.
  if (files.files.size() == 1 && !fs::is_directory(input, unknown))
    example.insert(example.begin() + 2, ExampleOutput(input, files.output_extension));
  else if (files.files.size() == 2)
    example.insert(example.begin() + 2, "--output-dir");  // FOLDER OUT
  else
    example.insert(example.begin() + 1 + static_cast<std::ptrdiff_t>(files.files.size()), {"--output-dir", "FOLDER"});
}

absl::StatusOr<FirstContact> ContactOf(const LasOptions& options, const config::SurveySettings& settings,
                                       std::vector<OpenDecision> open, const Arguments& given) {
  ASSIGN_OR_RETURN(const std::string input, annotate::FirstInput(LasExtensions(), options.files));
  ASSIGN_OR_RETURN(const LasLook look, LookAt(input, kPointsOfALook));
  FirstContact contact{.command = "las", .found = FoundLines(look), .open = std::move(open), .example = given};
  if (!settings.wants_total()) {
    contact.of_total = annotate::UndecidedOf(settings, {.has_level = true});
    contact.of_total.insert(contact.of_total.begin(),
                            {"sensor", "no sensor is named; give --sensor NAME (albtpu-query sensors lists them)"});
  }
  annotate::FileOptions files = options.files;
  if (options.format.has_value()) files.output_extension = formats::Extension(*options.format);
  if (options.csv.empty()) AddMissingOutput(files, ".las", contact);
  if (!options.flags.survey.has_value()) contact.remedy = {"init", input};
  if (!look.units_message.empty() && !options.beams.metres_per_unit.has_value())
    contact.open.push_back({"units", look.units_message});
  ASSIGN_OR_RETURN(const Suggestions suggestions, SuggestionsFor(std::span(&look, 1)));
  RETURN_IF_ERROR(CompleteExample(look, suggestions, contact));
  return contact;
}

}  // namespace albtpu::programs
