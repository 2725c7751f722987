#include "programs/query/plan_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/query/options.h"
#include "tables/s44.h"

namespace albtpu::programs {

void AddPlanOptions(CLI::App& command, PlanOptions& options) {
  AddSeaFlags(command, options.flags, {});
  AddTotalFlags(command, options.flags);
  const auto number = [&](const char* flag, auto& value, const char* help, double least, double most,
                          const char* unit) {
    return command.add_option(flag, value, help)->check(NumberIn(least, most, unit));
  };
  const auto list = [&](const char* flag, std::vector<double>& values, const char* help, double least, double most,
                        const char* unit) { AddList(command, flag, values, help, NumberIn(least, most, unit)); };
  number("--altitude", options.altitude, "Planned height above the water [m]", 10, 5000, "m")->capture_default_str();
  number("--incidence", options.incidence, "Planned angle of the beams from the vertical [degree]", 0, 60, "degree")
      ->capture_default_str();
  number("--divergence", options.divergence, "Full angle of the beam [mrad] (default: that of the sensor)", 0.01, 100,
         "mrad");
  list("--altitudes", options.altitudes, "Others to compare [m]", 10, 5000, "m");
  list("--incidences", options.incidences, "Others to compare [degree]", 0, 60, "degree");
  list("--kds", options.kds, "Diffuse attenuations at 532 nm to compare [1/m]", 0.001, 10, "1/m");
  list("--winds", options.winds, "Wind speeds, where no waves are given [m/s]", 0, 100, "m/s");
  list("--wave-heights", options.heights, "Significant heights of the waves of --hs and --swell [m]", 0.01, 30, "m");
  command.add_option("--order", options.order, "Required order of S-44")
      ->check(OneOf({kS44OrderNames.begin(), kS44OrderNames.end()}))
      ->capture_default_str();
  command.add_option("--output", options.output, "Folder for plan.html and plan.json")->check(NotEmpty("folder"));
  command.add_flag("--no-page", options.no_page, "Only plan.json, which needs no Python");
  command.add_flag("--json", options.json, "Print JSON");
  command.add_flag_callback(
      "--overwrite", [&options] { options.existing = Existing::kReplace; }, "Replace an earlier plan");
  AddSourceOptions(command, options.source);
  Group(command, "What is planned", {"--order", "--altitude", "--incidence", "--divergence"});
  Group(command, "What is compared", {"--winds", "--wave-heights", "--altitudes", "--incidences", "--kds"});
  Group(command, group::kOutput, {"--output", "--no-page", "--json", "--overwrite"});
}

absl::Status CheckPlannedSeas(const PlanOptions& options, const config::SeaSettings& sea) {
  const config::SeaSettings& flags = options.flags.settings.sea;
  if (sea.file.has_value() && (options.winds_given || options.heights_given))
    return formats::UsageError(
        "plan: --winds and --wave-heights have no effect with a file of the sea; leave them out");
  if (sea.has_waves() && options.winds_given)
    return formats::UsageError("plan: --winds has no effect over waves; give their heights by --wave-heights");
  if (!sea.has_waves() && options.heights_given)
    return formats::UsageError("plan: --wave-heights has no effect without waves; give their form by --hs and --tp");
  if (!sea.has_waves() && (flags.wind_speed || flags.wind_from))
    return formats::UsageError("plan: one wind has no effect without waves (all winds are planned); give --winds");
  if (!sea.waves.empty() &&
      std::ranges::all_of(sea.waves, [](const auto& each) { return each.significant_wave_height == 0; }))
    return formats::UsageError("plan: waves of height 0 have no form; give --hs above 0, which is varied");
  return absl::OkStatus();
}

}  // namespace albtpu::programs
