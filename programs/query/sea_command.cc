#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "annotate/seas/sea_correlation.h"
#include "annotate/seas/sea_facts.h"
#include "annotate/totals/water_column.h"
#include "formats/files/file_access.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "programs/query/survey_flags.h"
#include "sea/sea_time.h"
#include "sea/table/sea_table.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using nlohmann::ordered_json;

struct SeaCommandOptions {
  SurveyFlags flags;
  std::string output;  // FILE.h5
  Existing existing = Existing::kKeep;
  bool json = false;
};

constexpr std::array<std::string_view, 1> kFlagsOfWinds = {"--fetch"};

constexpr char kHeading[] =
    "time                    Hs     Tp  axis   wind    mss  mss<11  mss<20   share   "
    "2 sigma of the refraction at nadir [degree], along/across\n"
    "UTC                      m      s   deg    m/s                          known   "
    "0.2 m       0.6 m       1 m         2 m         5 m         own error  tail rules at 0.6 m\n";

std::string Row(const annotate::SeaFacts& facts, const annotate::SlopeFacts& slopes) {
  std::string row = absl::StrFormat(
      "%-20s %5.2f %6.1f %5.0f %6.1f %6.4f %7.4f %7.4f %7.3f", facts.time.has_value() ? SeaTimeText(*facts.time) : "-",
      facts.significant_wave_height, facts.peak_period, facts.axis, facts.sea.wind_speed_10m, slopes.mean_square_slope,
      slopes.below_11, slopes.below_20, facts.share_measured);
  for (const annotate::SlopeFacts::Footprint& footprint : slopes.footprints)
    absl::StrAppendFormat(&row, "   %4.2f/%-4.2f", footprint.refraction_along, footprint.refraction_cross);
  if (facts.error.has_value()) absl::StrAppendFormat(&row, "  %7.3f", facts.error->total / 2);
  if (!slopes.by_tail_rule.empty()) {
    const auto [least, greatest] = std::minmax_element(slopes.by_tail_rule.begin(), slopes.by_tail_rule.end() - 1);
    absl::StrAppendFormat(&row, "    %.2f to %.2f", *least, *greatest);
  }
  return row + "\n";
}

// The selected records: all, or the one at --sea-time.
std::vector<std::size_t> RecordsOf(const annotate::SeaTimeline& seas) {
  std::vector<std::size_t> records;
  if (!seas.by_time()) {
    records.push_back(seas.fixed().first);
    if (seas.fixed().second != seas.fixed().first) records.push_back(seas.fixed().second);
    return records;
  }
  for (std::size_t i = 0; i < seas.size(); ++i) records.push_back(i);
  return records;
}

absl::Status WriteSea(const annotate::SeaTimeline& seas, const SeaCommandOptions& options,
                      const config::SurveySettings& settings) {
  const std::vector<std::size_t> records = RecordsOf(seas);
  if (records.size() != 1) {
    return formats::UsageError(
        absl::StrCat("sea: --output holds the table of one sea (there are ", records.size(), " records ",
                     seas.by_time() ? annotate::SpanText(seas) : absl::StrCat("around ", *seas.settings().time),
                     "); choose the time of a record by "
                     "--sea-time, such as ",
                     SeaTimeText(*seas.record(records.back()).time)));
  }
  formats::FilesRead read;
  read.Add(FilesOf(options.flags, settings));
  RETURN_IF_ERROR(read.CheckNotReplacedBy(options.output));
  const double index = annotate::IndexOrUsual(settings.water);
  ASSIGN_OR_RETURN(const UncertaintyTable table, CompileSea(SeaCompiler(), seas.sea(records.front()), index));
  return WriteTable(table, options.output, options.existing);
}

absl::Status RunSea(const SeaCommandOptions& options) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  if (!settings.sea.has_waves())
    return formats::UsageError("sea: no waves are given; give a FILE, --survey, or --hs and --tp");
  ASSIGN_OR_RETURN(const annotate::SeaTimeline seas, annotate::SeaTimeline::Open(settings.sea));
  if (!options.output.empty()) RETURN_IF_ERROR(WriteSea(seas, options, settings));
  const annotate::SlopeSurvey slopes_of(annotate::IndexOrUsual(settings.water));
  ordered_json json = annotate::SeasHeadJson(seas);
  json["records"] = ordered_json::array();
  if (!options.json) std::cout << kHeading;
  for (const std::size_t record : RecordsOf(seas)) {
    const annotate::SeaFacts facts = annotate::FactsOf(seas, record);
    const annotate::SlopeFacts slopes = slopes_of(seas, record);
    if (!options.json) {
      std::cout << Row(facts, slopes);
      continue;
    }
    json["records"].push_back(annotate::Json(facts));
    json["records"].back().update(annotate::Json(slopes));
    json["records"].back()["correlation"] = annotate::CorrelationJson(seas, record);
  }
  if (options.json)
    std::cout << json.dump(2) << "\n";
  else if (!seas.series().assumed.empty())
    std::cout << "assumed: " << absl::StrJoin(seas.series().assumed, "; ") << "\n";
  return FlushStandardOutput();
}

}  // namespace

void AddSeaCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SeaCommandOptions>();
  CLI::App* command =
      program.add_subcommand("sea", "Show the states of the sea that a file has, and the slopes under beams");
  command->add_option("file", options->flags.settings.sea.file, "Spectra or heights of waves; or give --survey or --hs")
      ->type_name("FILE");
  AddSeaFlags(*command, options->flags, kFlagsOfWinds);
  command->add_flag("--json", options->json, "Print one JSON object with an array `records`")->group(group::kOutput);
  command->add_option("--output", options->output, "Write the table of the sea, of one instant, to this file")
      ->type_name("FILE.h5")
      ->check(NotEmpty("file"))
      ->group(group::kOutput);
  command
      ->add_flag_callback(
          "--overwrite", [options] { options->existing = Existing::kReplace; }, "Replace the output if it exists")
      ->group(group::kOutput);
  EndHelp(*command, "", "41010.data_spec --sea-depth 12",
          "41010.data_spec --sea-time 2020-06-08T03:50Z --output sea.h5");
  command->callback([options, &run] { run = [options] { return RunSea(*options); }; });
}

}  // namespace albtpu::programs
