#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "service/client/commands.h"
#include "service/client/csv_annotation.h"
#include "service/client/exit_status.h"
#include "service/client/options.h"

namespace albtpu::client {
namespace {

struct CsvOptions {
  std::string input, output;
  SharedOptions shared;
  FixedCoordinates fixed;
};

absl::Status RunCsv(const CsvOptions& options) {
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.shared.source);
  if (!source.ok()) return source.status();
  const absl::StatusOr<OutcomeCounts> counts = AnnotateCsv(
      options.input, options.output, options.shared.existing, options.fixed, options.shared.style, **source);
  if (!counts.ok()) return counts.status();
  Note(absl::StrCat(options.output, ": ", counts->Text()));
  return absl::OkStatus();
}

}  // namespace

void AddCsvCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<CsvOptions>();
  CLI::App* command = program.add_subcommand(
      "csv",
      "Repeat a CSV file of pulses (columns wind_speed, fetch, incidence, azimuth, footprint, depth, in any "
      "order, among others) with the uncertainty of each");
  command->add_option("input", options->input, "The file to read")->required()->type_name("IN.csv");
  command->add_option("output", options->output, "The file to write")->required()->type_name("OUT.csv");
  for (const AxisId axis : kAxes) AddCoordinate(*command, axis, options->fixed);
  AddSharedOptions(*command, options->shared);
  command->callback([options, &run] { run = [options] { return RunCsv(*options); }; });
}

}  // namespace albtpu::client
