// albtpu-generate: parses the arguments into the options of a command, and runs it.

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/command_line/manual.h"
#include "programs/generate/commands.h"
#include "programs/generate/point_flags.h"
#include "tables/version.h"

namespace albtpu::programs {
namespace {

// The headings under which --help lists options.
constexpr char kFiles[] = "Files";

constexpr char kSeeKeys[] = "`albtpu-generate keys` describes the keys of a campaign file.";

// "i/N" as a Shard, i from 0.
std::optional<Shard> ParseShard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto [slash, no_index] = std::from_chars(text.data(), end, shard.index);
  if (no_index != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [last, no_count] = std::from_chars(slash + 1, end, shard.count);
  if (no_count != std::errc() || last != end || shard.index < 0 || shard.index >= shard.count) return std::nullopt;
  return shard;
}

void AddTable(CLI::App& table, TableOptions& options, int& threads) {
  table.add_option("--campaign", options.campaign, "Campaign file")->required()->type_name("FILE.toml");
  CLI::Option* output =
      table.add_option("--output", options.output, "Table file to write (HDF5); required without --shard")
          ->type_name("FILE.h5");
  table.add_flag("--overwrite", options.overwrite, "Replace an existing table file")->needs(output);
  CLI::Option* work =
      table.add_option("--work", options.work, "Folder that keeps each finished unit; created if absent")
          ->type_name("DIR");
  table.add_flag("--resume", options.resume, "Use the units that are in the work folder already")->needs(work);
  table
      .add_option_function<std::string>(
          "--shard", [&options](const std::string& text) { options.shard = ParseShard(text); },
          "Compute only part i of N of the units (i from 0 to N - 1) into the work folder, and no table")
      ->type_name("i/N")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            if (ParseShard(text)) return {};
            return "'" + text + "' is not a shard; give i/N with i from 0 to N - 1, such as 0/4";
          },
          "", "shard"))
      ->needs(work)
      ->excludes(output);
  table.callback([&options] {
    if (options.output.empty() && !options.shard) throw CLI::RequiredError("--output");
  });
  AddThreads(table, threads);
  Group(table, kFiles, {"--campaign", "--output", "--overwrite"});
  Group(table, kWork, {"--work", "--resume", "--shard", "--threads"});
  EndHelp(table,
          absl::StrCat(kSeeKeys,
                       "\nWith --work, the same command with --resume continues an interrupted run without losing a "
                       "finished unit.\nUnder mpirun the ranks share the units and rank 0 writes the table, if this "
                       "program was built with MPI."),
          "--campaign survey.toml --output survey.h5",
          "--campaign survey.toml --output survey.h5 --work units --resume");
}

void AddMerge(CLI::App& merge, MergeOptions& options) {
  merge.add_option("--work", options.work, "Work folder of `table --work` or of all its shards")
      ->required()
      ->type_name("DIR");
  merge.add_option("--output", options.output, "Table file to write (HDF5)")->required()->type_name("FILE.h5");
  merge.add_flag("--overwrite", options.overwrite, "Replace an existing table file");
  Group(merge, kFiles, {"--work", "--output", "--overwrite"});
  EndHelp(merge, "", "--work units --output survey.h5", "--work units --output survey.h5 --overwrite");
}

void AddPlan(CLI::App& plan, PlanOptions& options, int& threads) {
  plan.add_option("--campaign", options.campaign, "Campaign file")->required()->type_name("FILE.toml");
  plan.add_option("--cores", options.cores, "Print the time on this many cores, too")
      ->type_name("N")
      ->check(WholeIn(1, 1'000'000));
  AddThreads(plan, threads);
  Group(plan, kFiles, {"--campaign"});
  Group(plan, kWork, {"--cores", "--threads"});
  EndHelp(plan, kSeeKeys, "--campaign survey.toml", "--campaign survey.toml --cores 64");
}

void AddValidate(CLI::App& validate, ValidateOptions& options, int& threads) {
  validate.add_option("--output", options.output, "Folder for report.html, CSV files and figures")
      ->required()
      ->type_name("DIR");
  validate.add_flag("--overwrite", options.overwrite, "Replace the files of an earlier report");
  validate.add_flag("--quick", options.quick, "Use fewer surfaces: a minute on two cores instead of ten");
  validate.add_option("--seed", options.seed, "Seed of the random numbers, a whole number (default: 1)")->check(Seed());
  AddThreads(validate, threads);
  Group(validate, kFiles, {"--output", "--overwrite"});
  Group(validate, kWork, {"--quick", "--seed", "--threads"});
  EndHelp(validate, "", "--output report", "--output report --quick --seed 2");
}

// Prints what went wrong, if anything, and makes sure that standard output was written.
int ExitCode(absl::Status status) {
  if (status.ok()) status = FlushStandardOutput();
  if (status.ok()) return 0;
  std::cerr << "albtpu-generate: " << std::string(status.message()) << '\n';
  return formats::kExitFailure;
}

int Run(int argc, char** argv) {
  CLI::App app("Computes lookup tables of the uncertainty that the sea surface adds to lidar bathymetry",
               "albtpu-generate");
  SetUpProgram(app, Version(), Commit());
  AddManualFlags(app, std::string(Version()));
  EndHelp(app, "albtpu-generate COMMAND --help lists the options of a command.",
          "table --campaign survey.toml --output survey.h5",
          "point --wind-speed 7 --incidence 12 --footprint 0.6 --depth 1,5,10,20");
  app.require_subcommand(1);
  int threads = 0;

  TableOptions table_options;
  CLI::App* table = app.add_subcommand("table", "Compute a table by Monte Carlo");
  AddTable(*table, table_options, threads);

  MergeOptions merge_options;
  CLI::App* merge = app.add_subcommand("merge", "Write the table from the units in a work folder");
  AddMerge(*merge, merge_options);

  PlanOptions plan_options;
  CLI::App* plan = app.add_subcommand("plan", "Estimate cells, memory and time of a campaign");
  AddPlan(*plan, plan_options, threads);

  CLI::App* keys = app.add_subcommand("keys", "Print the reference of the keys of a campaign file (Markdown)");
  EndHelp(*keys, "", "", "> campaign.md");

  PointOptions point_options;
  CLI::App* point = app.add_subcommand("point", "Compute the uncertainty of one beam over one sea");
  AddPoint(*point, point_options, threads);

  WaterPointOptions water_point_options;
  CLI::App* water_point =
      app.add_subcommand("water-point", "Compute the bias of one beam that the scattering of the water makes");
  AddWaterPoint(*water_point, water_point_options, threads);

  ValidateOptions validate_options;
  CLI::App* validate = app.add_subcommand("validate", "Report the tables and figures of the paper beside ours");
  AddValidate(*validate, validate_options, threads);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "albtpu-generate: " << UsageMessage(app, error) << '\n';
    return formats::kExitUsage;
  }

  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  if (*table) return ExitCode(RunTable(table_options));
  if (*merge) return ExitCode(RunMerge(merge_options));
  if (*keys) return ExitCode(RunKeys());
  if (*plan) return ExitCode(RunPlan(plan_options));
  if (*water_point) return ExitCode(RunWaterPoint(water_point_options));
  if (*validate) return ExitCode(RunValidate(validate_options));
  return ExitCode(RunPoint(point_options));
}

}  // namespace
}  // namespace albtpu::programs

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // A file at the size limit of the process makes write() fail.
  try {
    return albtpu::programs::Run(argc, argv);
  } catch (const std::exception& error) {  // out of memory or threads
    std::cerr << "albtpu-generate: " << error.what() << '\n';
    return albtpu::formats::kExitFailure;
  }
}
