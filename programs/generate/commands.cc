#include "programs/generate/commands.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/campaign_keys.h"
#include "generator/campaign/provenance.h"
#include "generator/campaign/water_cases.h"
#include "generator/water/water_column.h"
#include "sea/angle.h"
#include "status/status_macros.h"
#include "tables/axis.h"
#include "tables/default_tables.h"
#include "tables/file/output_folder.h"
#include "tables/uncertainty_table.h"
#include "tables/version.h"
#include "tables/water/water_schema.h"
#include "validation/published/published_table.h"
#include "validation/report/report.h"
#include "validation/report/study.h"
#include "validation/studies/studies.h"

namespace albtpu::programs {
absl::Status RunKeys() {
  std::cout << CampaignReference();
  return absl::OkStatus();
}

namespace {

struct NamedStudy {
  const char* name;
  StudyFunction run;
};

// In the order of the paper, followed by studies of our own.
constexpr NamedStudy kStudies[] = {
    {"Figures 2 and 3, the spectrum", SpectrumStudy},
    {"Table 2, the wave staff", WaveStaffStudy},
    {"Table 3, the Monte Carlo", PaperMonteCarloStudy},
    {"Table 4, the laboratory", LaboratoryStudy},
    {"Table 5, the angle method", AngleMethodStudy},
    {"the closed form", ClosedFormMapStudy},
    {"the real sea", RealSeaStudy},
    {"waves that are corrected away", CorrectedWavesStudy},
    {"the response theory", ResponseTheoryStudy},
    {"the water column", WaterColumnStudy},
};

// Checks the published tables before the studies start, which read them one by one.
absl::Status CheckPublished(const std::filesystem::path& folder) {
  for (const char* table : {"table2_wave_staff", "table3_simulated", "table4_empirical", "table5_thu_tvu"})
    RETURN_IF_ERROR(PublishedTable::Read(folder / (std::string(table) + ".csv")).status());
  return absl::OkStatus();
}

// The remedy for missing figures; empty if it is not known.
std::string Remedy(const std::string& why_figures_are_missing) {
  const bool no_library = why_figures_are_missing.find("ModuleNotFoundError") != std::string::npos ||
                          why_figures_are_missing.find("No such file or directory") != std::string::npos;
  return no_library ? "; install python3-matplotlib for them" : "";
}

std::string MadeBy(const ValidateOptions& options) {
  return absl::StrCat("Made by albtpu-generate validate", options.quick ? " --quick" : "", ", version ",
                      std::string(Version()), " (", std::string(Commit()), "), seed ", options.seed, ".");
}

}  // namespace

absl::Status RunValidate(const ValidateOptions& options) {
  const std::filesystem::path data = InstalledDataDirectory() / "validation";
  const ReportOptions report{options.output, data / "plots", MadeBy(options)};
  if (const absl::Status status = CheckPublished(data / "paper"); !status.ok()) return status;
  const Existing existing = options.overwrite ? Existing::kReplace : Existing::kKeep;
  if (const absl::Status status = PrepareFolder(report.folder, existing); !status.ok()) return status;

  std::vector<Study> studies;
  for (const NamedStudy& study : kStudies) {
    std::cerr << "albtpu-generate: study " << studies.size() + 1 << " of " << std::size(kStudies) << ": " << study.name
              << '\n';
    ASSIGN_OR_RETURN(Study found, study.run({data / "paper", options.quick, options.seed}));
    studies.push_back(std::move(found));
  }
  ASSIGN_OR_RETURN(const std::string why_figures_are_missing, WriteReport(studies, report));
  if (!why_figures_are_missing.empty()) {
    std::cerr << "albtpu-generate: figures are missing (" << why_figures_are_missing << ")"
              << Remedy(why_figures_are_missing) << '\n';
  }

  for (const Verdict verdict : {Verdict::kAgrees, Verdict::kDiffers, Verdict::kReported})
    std::cout << Name(verdict) << ' ' << Count(studies, verdict) << '\n';
  return absl::OkStatus();
}

namespace {

// Standard errors come from the scatter of this many pools of photons.
constexpr std::uint32_t kPools = 8;
// Relative standard error of the energy beyond which an echo has too few pairs.
constexpr double kMaxRelative = 0.05;

Estimate InMetres(const Estimate& relative, double depth) {
  return {relative.value * depth, relative.standard_error * depth};
}

void PrintJson(const WaterColumnBias& bias, double depth) {
  nlohmann::ordered_json json;
  const auto add = [&json](const std::string& name, const Estimate& estimate) {
    json[name] = estimate.value;
    json[name + "_standard_error"] = estimate.standard_error;
  };
  const DetectedBias& detected = *bias.by_pulse.front();
  for (const Detector detector : kDetectors) {
    const std::string name(kDetectorNames[Index(detector)]);
    add("bias_vertical_" + name, InMetres(detected.vertical[Index(detector)], depth));
  }
  for (const Detector detector : kDetectors) {
    const std::string name(kDetectorNames[Index(detector)]);
    add("bias_along_beam_" + name, InMetres(detected.along[Index(detector)], depth));
  }
  add("spot", InMetres(bias.spot, depth));
  add("stretch", detected.stretch);
  add("energy", bias.energy);
  std::cout << json.dump() << '\n';
}

void PrintText(const WaterColumnBias& bias, const WaterPointOptions& options) {
  const DetectedBias& detected = *bias.by_pulse.front();
  std::printf("reported minus true; +- is one standard error of %u photons\n", options.photons);
  std::printf("%-10s %-25s %-25s\n", "detector", "bias vertical m", "bias along beam m");
  for (const Detector detector : kDetectors) {
    const Estimate vertical = InMetres(detected.vertical[Index(detector)], options.depth);
    const Estimate along = InMetres(detected.along[Index(detector)], options.depth);
    std::printf("%-10s %9.4f +- %-12.4f %9.4f +- %-.4f\n", kDetectorNames[Index(detector)].data(), vertical.value,
                vertical.standard_error, along.value, along.standard_error);
  }
  const Estimate spot = InMetres(bias.spot, options.depth);
  std::printf("spot on the bottom, 1 sigma   %.3f +- %.3f m (resolution, not uncertainty)\n", spot.value,
              spot.standard_error);
  std::printf("echo's width over the pulse's %.3f +- %.3f\n", detected.stretch.value, detected.stretch.standard_error);
  std::printf("energy in the field of view   %.4f +- %.4f of unscattered light's\n", bias.energy.value,
              bias.energy.standard_error);
}

// The time of the processor that `work` takes on one thread: other programs do not prolong it.
template <typename Work>
double SecondsOf(const Work& work) {
  tbb::task_arena one_thread(1);
  const std::clock_t start = std::clock();
  one_thread.execute(work);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double SecondsOf(const SeaCase& sea_case, int realizations, Estimator estimator) {
  const Effort effort{.realizations = realizations, .most_realizations = realizations, .estimator = estimator};
  return SecondsOf([&] { Simulate(sea_case, effort, 1, 0); });
}

// Processor time of a campaign [s]: of all preparations, and of one realization of all sea cases.
struct Cost {
  double preparation = 0, realization = 0;
  double Of(int realizations) const { return preparation + realizations * realization; }
};

// Measured with a few realizations of a few sea cases that are spread over the campaign.
Cost Measure(const Campaign& campaign) {
  constexpr std::size_t kProbes = 24;
  constexpr int kFew = 4, kMore = 24;
  const std::size_t sea_cases = SeaCaseCount(campaign), probes = std::min(kProbes, sea_cases);
  const Estimator estimator = campaign.effort.estimator;
  SecondsOf(SeaCaseOf(campaign, sea_cases / 2), kFew,
            estimator);  // What a program does once is not part of a sea case.
  Cost cost;
  for (std::size_t p = 0; p < probes; ++p) {
    const SeaCase sea_case = SeaCaseOf(campaign, (2 * p + 1) * sea_cases / (2 * probes));
    const double few = SecondsOf(sea_case, kFew, estimator);
    const double more = SecondsOf(sea_case, kMore, estimator);
    const double realization = std::max(0.0, (more - few) / (kMore - kFew));
    const double share = static_cast<double>(sea_cases) / static_cast<double>(probes);
    cost.realization += share * realization;
    cost.preparation += share * std::max(0.0, few - kFew * realization);
  }
  return cost;
}

std::string Clock(double seconds) {
  return seconds < 5400 ? absl::StrFormat("%.0f s", seconds) : absl::StrFormat("%.1f h", seconds / 3600);
}

void PrintLine(const char* what, const std::string& value) { std::cout << absl::StrFormat("%-24s%s\n", what, value); }

// `least` and `most` are of one core [s].
void PrintTimes(double least, double most, int cores) {
  const std::size_t threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto clock = [&](double of) {
    return most > least ? Clock(least / of) + " to " + Clock(most / of) : Clock(least / of);
  };
  PrintLine("time of one core", clock(1));
  PrintLine("on this machine", absl::StrFormat("%s, if its %d threads are as good as cores",
                                               clock(static_cast<double>(threads)), threads));
  if (cores > 0) PrintLine("on so many cores", absl::StrFormat("%d: %s", cores, clock(cores)));
}

constexpr std::uint32_t kFewPhotons = 500, kMorePhotons = 2000;

// The time of `work` on a campaign: what does not depend on the number of photons, and what each of them adds.
template <typename Work>
std::pair<double, double> SecondsByPhotons(Campaign campaign, const Work& work) {
  campaign.water->photons = kFewPhotons;
  const double few = SecondsOf([&] { work(campaign); });
  campaign.water->photons = kMorePhotons;
  const double photon = std::max(0.0, SecondsOf([&] { work(campaign); }) - few) / (kMorePhotons - kFewPhotons);
  return {std::max(0.0, few - kFewPhotons * photon), photon};
}

Campaign With(Campaign campaign, WaterAxis axis, double node) {
  Axis& changed = campaign.axes[Index(axis)];
  changed = *Axis::Create(changed.schema(), {node}, changed.scale());  // A node of the same axis is valid.
  return campaign;
}

// The time of a water case, from parts of it. Walks and pairs take a time in proportion to the photons, measured with
// the longest pulse, whose echoes have few steps. All else finds the bottom in echoes, of each optical depth alike: it
// is measured at one.
double SecondsOfWaterCase(const Campaign& campaign, std::size_t index) {
  const auto compute = [index](const Campaign& part) { ComputeWaterCase(part, index); };
  const std::vector<double>& depths = campaign.axes[Index(WaterAxis::kOpticalDepth)].nodes();
  const double longest = campaign.axes[Index(WaterAxis::kPulseLength)].nodes().back();
  const double photon = SecondsByPhotons(With(campaign, WaterAxis::kPulseLength, longest), compute).second;
  Campaign one_depth = With(campaign, WaterAxis::kOpticalDepth, depths[depths.size() / 2]);
  one_depth.water->photons = kFewPhotons;  // Of hardly any time.
  return campaign.water->photons * photon + static_cast<double>(depths.size()) * SecondsOf([&] { compute(one_depth); });
}

// Of all cases and checked beams, by a few of them.
double SecondsOfWater(const Campaign& campaign) {
  constexpr std::size_t kProbes = 2;
  const std::size_t cases = WaterCaseCount(campaign), probes = std::min(kProbes, cases);
  double seconds = 0;
  for (std::size_t p = 0; p < probes; ++p) seconds += SecondsOfWaterCase(campaign, (2 * p + 1) * cases / (2 * probes));
  const auto [fixed, photon] =
      SecondsByPhotons(campaign, [](const Campaign& part) { ComputeDirectly(part, CheckedBeamOf(part, 0)); });
  return seconds * static_cast<double>(cases) / static_cast<double>(probes) +
         static_cast<double>(campaign.checked_pulses) * (fixed + campaign.water->photons * photon);
}

void PlanWater(const Campaign& campaign, int cores) {
  const double seconds = SecondsOfWater(campaign);
  std::size_t values = 0;
  for (const QuantitySchema& quantity : kWaterColumn.quantities) values += ValueCount(campaign.axes, quantity);
  PrintLine("waters and incidences", std::to_string(WaterCaseCount(campaign)));
  PrintLine("cells", std::to_string(ValueCount(campaign.axes, kWaterColumn.quantities.front())));
  PrintLine("checked beams", std::to_string(campaign.checked_pulses));
  PrintLine("table in memory", absl::StrFormat("%d KiB", 2 * sizeof(float) * values / 1024));
  PrintTimes(seconds, seconds, cores);
}

}  // namespace

absl::Status RunWaterPoint(const WaterPointOptions& options) {
  const double depth = options.depth;
  const WaterColumn column{.incidence = RadiansOfDegrees(options.incidence),
                           .refractive_index = options.refractive_index,
                           .group_index = options.group_index,
                           .scattering = options.scattering * depth,
                           .absorption = options.absorption / options.scattering,
                           .field_of_view = options.field_of_view / depth,
                           .footprint = options.footprint / depth};
  const std::array pulse_lengths = {PulseLengthOverDepth(options.pulse_length, depth, options.group_index)};
  const WaterColumnBias bias =
      ComputeWaterColumn(PhaseFunction::FournierForand(options.backscatter_fraction), column, pulse_lengths,
                         {.photons = options.photons / kPools, .pools = kPools, .seed = options.seed});
  if (!bias.by_pulse.front().has_value() || bias.energy.standard_error > kMaxRelative * bias.energy.value) {
    return absl::FailedPreconditionError(absl::StrCat(
        "no echo comes back from ", depth, " m that is significant with these photons (the water scatters ",
        column.scattering, " times on the way down); give a smaller depth, clearer water or more photons"));
  }
  options.json ? PrintJson(bias, depth) : PrintText(bias, options);
  return absl::OkStatus();
}

// Counts cells and bytes. Measures time on one thread and divides it by the number of cores.
absl::Status RunPlan(const PlanOptions& options) {
  ASSIGN_OR_RETURN(const Campaign campaign, ReadCampaign(options.campaign));

  PrintLine("campaign", campaign.id + ", version " + campaign.version);
  if (campaign.water) {
    PlanWater(campaign, options.cores);
    return absl::OkStatus();
  }
  std::size_t values = 0;
  for (const Quantity quantity : kQuantities) values += ValueCount(campaign.axes, quantity);
  const Effort& effort = campaign.effort;
  const Cost cost = Measure(campaign);
  const double checks = static_cast<double>(campaign.checked_pulses) *
                        SecondsOf([&] { ComputeDirectly(campaign, CheckedPulse(campaign, 0)); });
  const double least = cost.Of(effort.realizations) + checks;
  const double most = cost.Of(effort.most_realizations) + checks;

  PrintLine("seas and footprints", std::to_string(SeaCaseCount(campaign)));
  PrintLine("beams of each", std::to_string(SeaCaseOf(campaign, 0).beams.size()));
  PrintLine("cells", std::to_string(ValueCount(campaign.axes, Quantity::kThu)));
  PrintLine("checked pulses", std::to_string(campaign.checked_pulses));
  PrintLine("table in memory", absl::StrFormat("%d KiB", 2 * sizeof(float) * values / 1024));
  PrintLine("realizations",
            effort.most_realizations > effort.realizations
                ? absl::StrFormat("%d to %d, by the error of each beam", effort.realizations, effort.most_realizations)
                : std::to_string(effort.realizations));
  PrintTimes(least, most, options.cores);
  return absl::OkStatus();
}

}  // namespace albtpu::programs
