#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "formats/files/file_access.h"
#include "programs/command_line/command_line.h"
#include "programs/query/commands.h"
#include "programs/query/plan_options.h"
#include "programs/query/survey_flags.h"
#include "quality/planning/survey_plan.h"
#include "quality/report/report_folder.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

absl::StatusOr<annotate::TotalPlan> PlanOf(const config::SurveySettings& settings) {
  const bool level = settings.surface.level.has_value();
  return annotate::PlanTotal(settings, {.coverage = Coverage::kP95, .has_surface_returns = !level, .has_level = level});
}

// In ascending order, each once. Values too small for float32, the precision of table queries, become 0.
std::vector<double> Rising(std::vector<double> values) {
  for (double& value : values)
    if (value < std::numeric_limits<float>::min()) value = 0;
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// The sea with its waves scaled to this significant height in total.
config::SeaSettings WithHeight(config::SeaSettings sea, double height) {
  double energy = 0;
  for (const JonswapWaves& each : sea.waves) energy += each.significant_wave_height * each.significant_wave_height;
  for (JonswapWaves& each : sea.waves) each.significant_wave_height *= height / std::sqrt(energy);
  return sea;
}

class Planner {
 public:
  Planner(const PlanOptions& options, const config::SurveySettings& settings)
      : options_(options), settings_(settings), sea_(settings.sea) {}

  absl::StatusOr<quality::SurveyPlan> Make() {
    RETURN_IF_ERROR(CheckPlannedSeas(options_, sea_));
    if (sea_.file.has_value()) RETURN_IF_ERROR(OpenSeries());
    const bool waves = sea_.has_waves();
    const std::size_t seas = sea_.file.has_value() ? std::max<std::size_t>(times_.size(), 1)
                             : waves               ? options_.heights.size()
                                                   : options_.winds.size();
    annotate::FileProgress progress("conditions", 1, options_.kds.size() + seas);
    progress.NextFile();
    annotate::FileProgress::File shown(progress, "plan");
    RETURN_IF_ERROR(Prepare(shown));
    for (const double time : times_) {
      time_ = time;
      RETURN_IF_ERROR(AddSea(0));
      ++done_;
      shown.Reach(done_, done_);
    }
    for (std::size_t i = 0; i < plan_.seas.size(); ++i) {
      absl::Status status = absl::OkStatus();
      if (waves && !sea_.file.has_value()) {
        const config::SeaSettings sea = WithHeight(sea_, plan_.seas[i]);
        status = config::CheckSea(sea);
        if (status.ok()) status = Open(sea);
      }
      if (!status.ok() && i > 0) {  // Waves that break, or are too steep for their period.
        annotate::Note(absl::StrCat("--wave-heights: ", plan_.seas[i], " m and more left out: ", status.message()));
        plan_.seas.resize(i);
        break;
      }
      if (status.ok()) status = AddSea(plan_.seas[i]);
      if (!status.ok()) return status;
      ++done_;
      shown.Reach(done_, done_);
    }
    if (std::ranges::none_of(plan_.planned, [](const quality::Reaches& reaches) { return reaches.back().is_known(); }))
      return formats::UsageError(
          "plan: no table knows the planned beam over any of these seas; give another --incidence, --altitude or "
          "--divergence");
    return std::move(plan_);
  }

 private:
  static constexpr std::size_t kMostHours = 100'000;  // Eleven years.

  // Opens the file of the sea: whole hours where it goes by time, otherwise its only state.
  absl::Status OpenSeries() {
    RETURN_IF_ERROR(Open(sea_));
    const annotate::SeaTimeline& seas = *answerer_->timeline();
    if (!seas.by_time()) {
      const annotate::BetweenRecords& of = seas.fixed();
      const auto height = [&](std::size_t record) { return seas.record(record).significant_wave_height(); };
      plan_.seas = {
          std::sqrt((1 - of.weight) * std::pow(height(of.first), 2) + of.weight * std::pow(height(of.second), 2))};
      return absl::OkStatus();
    }
    constexpr double kHour = 3600;  // s
    const double first = std::ceil(seas.start() / kHour) * kHour, last = std::floor(seas.end() / kHour) * kHour;
    if ((last - first) / kHour > kMostHours)
      return absl::InvalidArgumentError(
          absl::StrCat(*sea_.file, ": has more than ", kMostHours, " hours; give a file of fewer years"));
    plan_.hours = {.first = first, .last = last};
    for (double time = first; time <= last; time += kHour) {
      if (seas.At(time).has_value())
        times_.push_back(time);
      else
        ++plan_.hours->without_sea;
    }
    if (times_.empty())
      return absl::InvalidArgumentError(
          absl::StrCat(*sea_.file, ": has no sea at a whole hour; give one instant of it by --sea-time"));
    return absl::OkStatus();
  }

  absl::Status Prepare(annotate::FileProgress::File& shown) {
    if (options_.kds_given && !wants_column())
      return formats::UsageError(
          "plan: --kds has no effect without the contribution of the water column; describe the water in --survey");
    ASSIGN_OR_RETURN(planned_, PlanOf(settings_));
    if (options_.divergence.has_value()) {
      divergence_ = *options_.divergence;
    } else if (planned_.divergence.has_value()) {
      divergence_ = *planned_.divergence;
      planned_.numbers.push_back(annotate::AssumedDivergence(divergence_));
    } else {
      return formats::UsageError(absl::StrCat("plan: the divergence of ", planned_.numbers.front().source,
                                              " is not known; give it by --divergence in mrad"));
    }
    plan_.order = *FindS44Order(options_.order);
    const bool waves = sea_.has_waves();
    plan_.sea_name = waves ? "significant_wave_height" : "wind_speed";
    plan_.sea_unit = waves ? "m" : "m/s";
    if (!sea_.file.has_value()) plan_.seas = Rising(waves ? options_.heights : options_.winds);
    plan_.altitude = options_.altitude;
    plan_.incidence = options_.incidence;
    plan_.numbers = planned_.numbers;
    plan_.located = std::string(kSurfaceLocationNames[static_cast<std::size_t>(planned_.options.located)]);
    plan_.located_by = settings_.surface.located.has_value() ? "the user"
                       : settings_.surface.level.has_value() ? "assumed: by the water level"
                                                             : "assumed: no water level is given";
    std::vector<double> incidences = Rising(options_.incidences);
    if (!waves) {
      RETURN_IF_ERROR(Open(sea_));
      RETURN_IF_ERROR(CheckFetch());
      RETURN_IF_ERROR(KeepWithin(AxisId::kWindSpeed, "--winds", plan_.seas));
      RETURN_IF_ERROR(KeepWithin(AxisId::kIncidence, "--incidences", incidences));
    }
    plan_.axes = {{"altitude", "m", Rising(options_.altitudes), {}}, {"incidence", "degree", incidences, {}}};
    return PrepareWaters(shown);
  }

  // A total for each attenuation, if the contribution of the water column is wanted.
  absl::Status PrepareWaters(annotate::FileProgress::File& shown) {
    if (wants_column()) {
      plan_.axes.push_back({"kd", "1/m", Rising(options_.kds), {}});
      for (const double kd : plan_.axes.back().values) {
        config::SurveySettings settings = settings_;
        config::WaterSettings& water = settings.water;
        water.kd = kd;
        water.kd_kind = "diffuse532";
        water.kd_sigma = water.secchi = water.absorption = water.scattering = std::nullopt;
        water.jerlov = std::nullopt;
        ASSIGN_OR_RETURN(annotate::TotalPlan total, PlanOf(settings));
        of_waters_.push_back(std::move(total));
        ++done_;
        shown.Reach(done_, done_);
      }
    }
    for (quality::PlannedAxis& axis : plan_.axes) axis.reaches.resize(axis.values.size());
    return absl::OkStatus();
  }

  absl::Status Open(const config::SeaSettings& sea) {
    ASSIGN_OR_RETURN(Answerer opened, Answerer::Open(sea, options_.source, annotate::IndexOrUsual(settings_.water)));
    answerer_ = std::make_unique<Answerer>(std::move(opened));
    return absl::OkStatus();
  }

  // A longer fetch than that of the table is as good as unlimited.
  absl::Status CheckFetch() const {
    const double fetch = sea_.fetch.value_or(std::numeric_limits<double>::infinity());
    const client::AxisRange& range = answerer_->source().table().axes[Index(AxisId::kFetch)];
    if (fetch >= range.first) return absl::OkStatus();
    return formats::UsageError(absl::StrCat("plan: the fetch of ", fetch, " m is below that of the table, which has ",
                                            range.first, " to ", range.last, " m; give a longer --fetch, or waves"));
  }

  // Keeps the values that the table covers; others would look like conditions under which no depth can be reached.
  absl::Status KeepWithin(AxisId axis, const std::string& flag, std::vector<double>& values) const {
    const client::AxisRange& range = answerer_->source().table().axes[Index(axis)];
    const auto is_outside = [&](double value) { return value < range.first || value > range.last; };
    std::string left_out;
    for (const double value : values)
      if (is_outside(value)) absl::StrAppend(&left_out, left_out.empty() ? "" : ", ", value);
    std::erase_if(values, is_outside);
    const std::string what =
        absl::StrCat(flag, ": ", left_out, " left out (the table has ", range.first, " to ", range.last, ")");
    if (values.empty()) return formats::UsageError(absl::StrCat("plan: ", what, "; nothing is left, give others"));
    if (!left_out.empty()) annotate::Note(what);
    return absl::OkStatus();
  }

  absl::Status AddSea(double sea) {
    ASSIGN_OR_RETURN(const quality::Reaches planned, At(sea, planned_, options_.altitude, options_.incidence));
    plan_.planned.push_back(planned);
    for (quality::PlannedAxis& axis : plan_.axes)
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        const double value = axis.values[i];
        ASSIGN_OR_RETURN(const quality::Reaches reaches, At(sea, axis.name == "kd" ? of_waters_[i] : planned_,
                                                            axis.name == "altitude" ? value : options_.altitude,
                                                            axis.name == "incidence" ? value : options_.incidence));
        axis.reaches[i].push_back(reaches);
      }
    return absl::OkStatus();
  }

  absl::StatusOr<quality::Reaches> At(double sea, annotate::TotalPlan plan, double altitude, double incidence) {
    const annotate::AnswerSource source = answerer_->source();
    quality::PlannedBeam beam{.altitude = altitude,
                              .incidence = incidence,
                              .footprint = annotate::FootprintAtIncidence(altitude, divergence_, incidence),
                              .wind_speed = {},
                              .fetch = {}};
    beam.time = time_;
    if (!sea_.has_waves()) {
      annotate::FixedInputs wind;
      TakeWind(sea_, wind);
      const std::optional<float>& fetch = wind[annotate::PulseInput::kFetch];
      beam.wind_speed = sea;
      if (fetch.has_value()) beam.fetch = *fetch;
      plan.wave_height = annotate::WaveHeightOfWind(sea, fetch, annotate::SpectrumOf(source.table()));
    }
    return quality::ReachOf(plan, source, beam);
  }

  // Whether the water is described, and its share not left out.
  bool wants_column() const {
    return IsAnyGiven(config::kWaterKeys, settings_.water) && !settings_.water.without_column();
  }

  const PlanOptions& options_;
  const config::SurveySettings& settings_;
  config::SeaSettings sea_;
  std::uint64_t done_ = 0;     // Waters and seas.
  std::vector<double> times_;  // s since 1970: whole hours with a sea, of a file that goes by time.
  std::optional<double> time_;
  double divergence_ = 0;  // mrad
  annotate::TotalPlan planned_;
  std::vector<annotate::TotalPlan> of_waters_;
  std::unique_ptr<Answerer> answerer_;
  quality::SurveyPlan plan_;
};

absl::Status RunPlan(const PlanOptions& options) {
  ASSIGN_OR_RETURN(const config::SurveySettings settings, SettingsOf(options.flags));
  if (!settings.wants_total())
    return formats::UsageError("plan: the sensor is missing; name it by --sensor or in --survey");
  if (!options.output.empty() && !options.no_page) RETURN_IF_ERROR(quality::CheckPageCanBeDrawn());
  std::optional<quality::NewFolder> folder;
  if (!options.output.empty()) {
    formats::FilesRead read;
    read.Add(FilesOf(options.flags, settings));
    read.Add(options.source.file);
    RETURN_IF_ERROR(read.CheckNotReplacedIn(options.output, quality::kPlanFiles));
    folder.emplace(options.output);
    RETURN_IF_ERROR(PrepareFolder(options.output, options.existing));
  }
  ASSIGN_OR_RETURN(quality::SurveyPlan plan, Planner(options, settings).Make());
  const nlohmann::ordered_json json = quality::PlanJson(plan);
  if (!options.output.empty()) RETURN_IF_ERROR(quality::WritePlan(json, !options.no_page, options.output));
  std::cout << (options.json ? json.dump(2) + "\n" : quality::PlanText(plan));
  return FlushStandardOutput();
}

}  // namespace

void AddPlanCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command = program.add_subcommand(
      "plan", "The depth down to which each order of S-44 can be met: for wind or waves, altitude, incidence, water");
  AddPlanOptions(*command, *options);
  EndHelp(
      *command,
      "With a file of the sea that goes by time, the share of its whole hours in which each order is met, by depth;\n"
      "tides are not considered.\n"
      "Whether the laser sees the bottom at these depths is another question.",
      "--sensor riegl-vq-880-g --datum-sigma 0.08 --water-column none --order special",
      "--survey survey.toml --altitudes 300,400,500 --order 1a --output plan");
  command->callback([options, command, &run] {
    options->kds_given = command->count("--kds") > 0;
    options->winds_given = command->count("--winds") > 0;
    options->heights_given = command->count("--wave-heights") > 0;
    run = [options] { return RunPlan(*options); };
  });
}

}  // namespace albtpu::programs
