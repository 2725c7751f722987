#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "config/sensors/sensor.h"
#include "config/survey_draft.h"
#include "config/survey_settings.h"
#include "programs/command_line/command_line.h"
#include "programs/query/beam_options.h"
#include "programs/query/commands.h"
#include "programs/query/first_contact.h"
#include "programs/query/las_look.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using config::OpenDecision;

// The names of the sensors in one line.
std::string SensorNames() {
  const absl::StatusOr<std::vector<config::Sensor>> sensors = config::ListSensors();
  if (!sensors.ok()) return "";
  return absl::StrJoin(*sensors, ", ", [](std::string* text, const config::Sensor& each) { text->append(each.name); });
}

// What nothing that was found answers.
std::vector<OpenDecision> DecisionsOf(const Suggestions& suggestions) {
  const std::string names = SensorNames();
  std::vector<OpenDecision> open = {
      {"sensor", absl::StrCat("the lidar, for totals; without it, only the contribution of the sea surface is given",
                              names.empty() ? "" : ". Known: " + names + "; others by a file of their own")}};
  for (const OpenDecision& decision : OpenDecisionsOf(BeamOptions(), config::SurveySettings()))
    if (decision.section != "beam size" && (decision.section != "trajectory" || suggestions.times))
      open.push_back(decision);
  for (const OpenDecision& decision : annotate::UndecidedOf(config::SurveySettings(), {.has_level = true}))
    open.push_back(decision);
  open.push_back({"output", "no points are of a class that stands for the bottom; name those that do by classes"});
  std::erase_if(open, [&](const OpenDecision& decision) {
    const config::DraftValue* first = FirstOf(suggestions, decision.section);
    if (decision.section == "output") return first == nullptr || first->found;
    return first != nullptr && first->found;
  });
  return open;
}

// So many files are described: a survey file is read up to a length that those of a whole survey would exceed.
constexpr std::size_t kMostFiles = 8;

std::vector<std::string> Heading(const std::vector<LasLook>& looks, const Suggestions& suggestions) {
  std::vector<std::string> lines = {
      "A survey file for albtpu-query, begun by `albtpu-query init`. What the files say is filled in. What must be "
      "decided is marked DECIDE: remove the # from one of the lines below such a mark and put in what holds for the "
      "survey. All other keys stand with their unit, range and default; a # before a key leaves it at its default.",
      "Then:"};
  std::vector<std::string> command = {"las"};
  if (looks.size() == 1)
    command.insert(command.end(), {looks[0].path, ExampleOutput(looks[0].path)});
  else
    command.insert(command.end(), {"FILES", "--output-dir", "FOLDER"});
  command.insert(command.end(), {"--survey", "survey.toml"});
  command.insert(command.end(), suggestions.units.begin(), suggestions.units.end());
  std::vector<std::string> by_angle = suggestions.by_angle;
  by_angle.insert(by_angle.end(), kExampleAltitude.begin(), kExampleAltitude.end());
  if (!suggestions.times) command.insert(command.end(), by_angle.begin(), by_angle.end());
  lines.push_back("  " + CommandLine(command));
  lines.push_back(suggestions.times
                      ? absl::StrCat("Where there is no trajectory at all, `", absl::StrJoin(by_angle, " "),
                                     "` in that line takes its place.")
                      : absl::StrCat("The points", suggestions.some_times ? " of some files" : "",
                                     " have no GPS times, so that no trajectory can be used",
                                     suggestions.some_times ? " for them" : "", "; leave [trajectory] as it is."));
  lines.push_back(
      "Without a sensor, or with one whose divergence is not known, add `--divergence MRAD` (or `--footprint M`) to "
      "that line.");
  lines.push_back("");
  lines.push_back("Found:");
  for (const LasLook& look : std::span(looks).first(std::min(looks.size(), kMostFiles)))
    for (const std::string& found : FoundLines(look)) lines.push_back("  " + found);
  if (looks.size() > kMostFiles)
    lines.push_back(absl::StrCat("  and ", looks.size() - kMostFiles,
                                 " more files; `albtpu-query init FILE` says the same of each"));
  for (const std::string& difference : Differences(looks)) lines.push_back("The files differ: " + difference + ".");
  std::vector<std::string> to_decide;
  for (const LasLook& look : looks)
    for (const std::string& message : {look.crs_message, look.units_message})
      if (!message.empty()) to_decide.push_back("DECIDE, on the command line: " + message);
  for (const std::string& message : std::span(to_decide).first(std::min(to_decide.size(), kMostFiles)))
    lines.push_back(message);
  if (to_decide.size() > kMostFiles)
    lines.push_back(absl::StrCat("DECIDE the same of ", to_decide.size() - kMostFiles, " more."));
  for (std::string& line : lines) line = PrintableText(line);  // A line break would end the comment.
  return lines;
}

absl::Status RunInit(const std::vector<std::string>& files) {
  std::vector<LasLook> looks;
  for (const std::string& file : files) {
    ASSIGN_OR_RETURN(LasLook look, LookAt(file));
    looks.push_back(std::move(look));
  }
  ASSIGN_OR_RETURN(const Suggestions suggestions, SuggestionsFor(looks));
  std::cout << config::DraftText(
      {.heading = Heading(looks, suggestions), .decisions = DecisionsOf(suggestions), .values = suggestions.values});
  return FlushStandardOutput();
}

}  // namespace

void AddInitCommand(CLI::App& program, Run& run) {
  const auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* command = program.add_subcommand(
      "init",
      "Look at LAS and LAZ files and print a survey file for them: what they say, what must be decided, defaults");
  command->add_option("files", *files, "LAS or LAZ files of one survey")->required()->type_name("FILE.las");
  EndHelp(*command, "Nothing is written but standard output.", "line.las > survey.toml", "line_1.laz line_2.laz");
  command->callback([files, &run] { run = [files] { return RunInit(*files); }; });
}

}  // namespace albtpu::programs
