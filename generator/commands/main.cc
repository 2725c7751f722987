// albtpu-generate: flags -> options -> run.

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "generator/commands/commands.h"
#include "sea/wave_state.h"
#include "tables/version.h"

namespace {

using albtpu::MergeOptions;
using albtpu::PlanOptions;
using albtpu::PointOptions;
using albtpu::Shard;
using albtpu::TableOptions;
using albtpu::ValidateOptions;

constexpr int kFailure = 1, kBadUsage = 2;

// A finite number in a range, both ends included unless `open_below`; "nan" and "inf" are numbers to CLI11.
CLI::Validator NumberIn(double least, double most, bool open_below = false) {
  const std::string right = std::string("a number ") + (open_below ? "above " : "from ") +
                            CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0;
        const bool number = CLI::detail::lexical_cast(text, x);
        if (number && std::isfinite(x) && x <= most && (open_below ? x > least : x >= least)) return {};
        return "'" + text + "' is not " + right;
      },
      "", "number");
}

CLI::Validator Fetch() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double x = 0;
        if (CLI::detail::lexical_cast(text, x) && x > 0) return {};
        return "'" + text + "' is not a fetch: give metres above 0, or inf for the fully developed sea";
      },
      "", "fetch");
}

CLI::Validator Seed() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::int64_t seed = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
        if (error == std::errc() && end == text.data() + text.size() && seed >= 0) return {};
        return "'" + text + "' is not a whole number from 0 to 9223372036854775807";
      },
      "", "seed");
}

// "i/N" as a Shard, i from 0.
std::optional<Shard> ParseShard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto [slash, no_index] = std::from_chars(text.data(), end, shard.index);
  if (no_index != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [last, no_count] = std::from_chars(slash + 1, end, shard.count);
  if (no_count != std::errc() || last != end || shard.index < 0 || shard.index >= shard.count)
    return std::nullopt;
  return shard;
}

void AddTable(CLI::App& table, TableOptions& options) {
  table.footer(
      "Under mpirun the ranks share the work and rank 0 alone writes, if this program was built with MPI.\n"
      "With --work a killed run loses no finished unit: the same command with --resume goes on.");
  table.add_option("--campaign", options.campaign, "TOML file")->required();
  CLI::Option* output = table.add_option("--output", options.output, "HDF5 file to write");
  table.add_flag("--overwrite", options.overwrite, "replace an existing file")->needs(output);
  CLI::Option* work =
      table.add_option("--work", options.work, "folder to keep each finished unit in, made if need be");
  table.add_flag("--resume", options.resume, "take the units that are in the work folder")->needs(work);
  table
      .add_option_function<std::string>(
          "--shard", [&options](const std::string& text) { options.shard = ParseShard(text); },
          "i/N, i from 0: compute this one of N parts of the units into the work folder, no table")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            if (ParseShard(text)) return {};
            return "'" + text + "' is not a shard: give i/N, i from 0 to N - 1, as 0/4";
          },
          "", "shard"))
      ->needs(work)
      ->excludes(output);
  table.callback([&options] {
    if (options.output.empty() && !options.shard) throw CLI::RequiredError("--output");
  });
}

void AddMerge(CLI::App& merge, MergeOptions& options) {
  merge.add_option("--work", options.work, "folder that `table --work` or its shards filled")->required();
  merge.add_option("--output", options.output, "HDF5 file to write")->required();
  merge.add_flag("--overwrite", options.overwrite, "replace an existing file");
}

void AddPoint(CLI::App& point, PointOptions& options) {
  point.add_option("--wind-speed", options.wind_speed, "wind at 10 m height, m/s")
      ->required()
      ->check(NumberIn(0, 50, true));
  point.add_option("--fetch", options.fetch, "m, or inf: fully developed (default)")->check(Fetch());
  const std::vector<std::string> spectra(albtpu::kSpectrumKeys.begin(), albtpu::kSpectrumKeys.end());
  std::string described;  // "apel (default) or elfouhaily"
  for (const std::string& key : spectra) {
    described += (described.empty() ? "" : " or ") + key + (key == options.spectrum ? " (default)" : "");
  }
  point.add_option("--spectrum", options.spectrum, "of the waves: " + described)
      ->check(CLI::IsMember(spectra));
  point
      .add_option("--corrected-above", options.corrected_above,
                  "m; longer waves are corrected for by the local slope and left out")
      ->check(NumberIn(0.1, 1e6));
  point.add_option("--incidence", options.incidence, "from the vertical, in air, degree")
      ->required()
      ->check(NumberIn(0, 60));
  point
      .add_option("--azimuth", options.azimuth,
                  "of the beam from downwind, degree; absent: the worse of 0 and 90")
      ->check(NumberIn(-1e6, 1e6));
  point.add_option("--footprint", options.footprint, "diameter at the surface, across the beam, m")
      ->required()
      ->check(NumberIn(0, 1000, true));
  point.add_option("--depth", options.depth, "m, several with commas")
      ->required()
      ->delimiter(',')
      ->check(NumberIn(0, 1e4));
  point.add_option("--profile", options.profile, "uniform (default) or gaussian")
      ->check(CLI::IsMember({"uniform", "gaussian"}));
  point.add_option("--refractive-index", options.refractive_index, "of the water (default 1.33)")
      ->check(NumberIn(1.01, 2));
  point
      .add_option("--relative-error", options.relative_error,
                  "to go on to, of refraction, THU and TVU (default 0.01)")
      ->check(NumberIn(1e-4, 0.5));
  point.add_option("--estimator", options.estimator, "control_variate (default) or plain: tracing alone")
      ->check(CLI::IsMember({"control_variate", "plain"}));
  point.add_option("--seed", options.seed, "of the random numbers, a whole number (default 1)")
      ->check(Seed());
  point.add_flag("--json", options.json, "print one JSON object");
}

// Prints what went wrong, if anything, and makes sure that what was printed got through.
int ExitCode(absl::Status status) {
  if (status.ok() && (std::fflush(stdout) != 0 || !std::cout.flush())) {
    status = absl::DataLossError("standard output: cannot be written: send it where there is room");
  }
  if (status.ok()) return 0;
  std::cerr << "albtpu-generate: " << std::string(status.message()) << '\n';
  return kFailure;
}

int Run(int argc, char** argv) {
  CLI::App app("Makes lookup tables of the uncertainty that the sea surface adds to lidar bathymetry",
               "albtpu-generate");
  app.set_version_flag("--version", "albtpu-generate " + std::string(albtpu::Version()) + " (" +
                                        std::string(albtpu::Commit()) + ")");
  app.require_subcommand(1);
  int threads = 0;

  TableOptions table_options;
  CLI::App* table = app.add_subcommand("table", "make a table by Monte Carlo");
  AddTable(*table, table_options);

  MergeOptions merge_options;
  CLI::App* merge = app.add_subcommand("merge", "make the table of the units in a work folder");
  AddMerge(*merge, merge_options);

  PlanOptions plan_options;
  CLI::App* plan = app.add_subcommand("plan", "say what a campaign will take, before the work");
  plan->add_option("--campaign", plan_options.campaign, "TOML file")->required();
  plan->add_option("--cores", plan_options.cores, "say also how long so many cores would take")
      ->check(CLI::Range(1, 1'000'000));

  PointOptions point_options;
  CLI::App* point = app.add_subcommand("point", "the uncertainty of one beam over one sea");
  AddPoint(*point, point_options);

  ValidateOptions validate_options;
  CLI::App* validate =
      app.add_subcommand("validate", "the paper's tables and figures, ours beside them, as a report");
  validate->add_option("--output", validate_options.output, "folder for report.html, CSV files and figures")
      ->required();
  validate->add_flag("--quick", validate_options.quick, "fewer surfaces: minutes on two cores");
  validate->add_option("--seed", validate_options.seed, "of the random numbers, a whole number (default 1)")
      ->check(Seed());
  validate->add_flag("--overwrite", validate_options.overwrite, "replace the files of an earlier report");

  for (CLI::App* command : {table, merge, plan, point, validate}) {
    command->add_option("--threads", threads, "all cores unless given")->check(CLI::Range(1, 4096));
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "albtpu-generate: " << error.what() << "; see --help\n";
    return kBadUsage;
  }

  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  if (*table) return ExitCode(RunTable(table_options));
  if (*merge) return ExitCode(RunMerge(merge_options));
  if (*plan) return ExitCode(RunPlan(plan_options));
  if (*validate) return ExitCode(RunValidate(validate_options));
  return ExitCode(RunPoint(point_options));
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // A file grown past its limit is an error of write(), not the end.
  try {
    return Run(argc, argv);
  } catch (const std::exception& error) {  // no memory, no threads
    std::cerr << "albtpu-generate: " << error.what() << '\n';
    return kFailure;
  }
}
