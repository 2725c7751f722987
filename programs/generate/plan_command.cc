#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>

#include "absl/strings/str_format.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/interpolation_check.h"
#include "generator/campaign/water_cases.h"
#include "programs/generate/commands.h"
#include "tables/uncertainty_table.h"

namespace albtpu::programs {
namespace {

// The time that `work` takes on one thread.
template <typename Work>
double SecondsOf(const Work& work) {
  tbb::task_arena one_thread(1);
  const auto start = std::chrono::steady_clock::now();
  one_thread.execute(work);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double SecondsOf(const SeaCase& sea_case, int realizations, Estimator estimator) {
  const Effort effort{
      .realizations = realizations, .most_realizations = realizations, .estimator = estimator};
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
  Cost cost;
  for (std::size_t p = 0; p < probes; ++p) {
    const SeaCase sea_case = SeaCaseOf(campaign, (2 * p + 1) * sea_cases / (2 * probes));
    const double few = SecondsOf(sea_case, kFew, campaign.effort.estimator);
    const double more = SecondsOf(sea_case, kMore, campaign.effort.estimator);
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

void PrintLine(const char* what, const std::string& value) {
  std::cout << absl::StrFormat("%-24s%s\n", what, value);
}

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

// The same for the water column, whose cases take a time in proportion to their scatterings.
void PlanWater(const Campaign& campaign, int cores) {
  constexpr std::size_t kProbes = 2;
  const std::size_t cases = WaterCaseCount(campaign), probes = std::min(kProbes, cases);
  double seconds = 0;
  for (std::size_t p = 0; p < probes; ++p) {
    seconds += SecondsOf([&] { ComputeWaterCase(campaign, (2 * p + 1) * cases / (2 * probes)); });
  }
  seconds *= static_cast<double>(cases) / static_cast<double>(probes);
  seconds += static_cast<double>(campaign.checked_pulses) *
             SecondsOf([&] { ComputeDirectly(campaign, CheckedBeamOf(campaign, 0)); });
  std::size_t values = 0;
  for (const QuantitySchema& quantity : kWaterColumn.quantities)
    values += ValueCount(campaign.axes, quantity);
  PrintLine("waters and incidences", std::to_string(cases));
  PrintLine("cells", std::to_string(ValueCount(campaign.axes, kWaterColumn.quantities.front())));
  PrintLine("checked beams", std::to_string(campaign.checked_pulses));
  PrintLine("table in memory", absl::StrFormat("%d KiB", 2 * sizeof(float) * values / 1024));
  PrintTimes(seconds, seconds, cores);
}

}  // namespace

// Counts cells and bytes. Measures time on one thread and divides it by the number of cores.
absl::Status RunPlan(const PlanOptions& options) {
  const absl::StatusOr<Campaign> campaign = ReadCampaign(options.campaign);
  if (!campaign.ok()) return campaign.status();

  PrintLine("campaign", campaign->id + ", version " + campaign->version);
  if (campaign->water) {
    PlanWater(*campaign, options.cores);
    return absl::OkStatus();
  }
  std::size_t values = 0;
  for (const Quantity quantity : kQuantities) values += ValueCount(campaign->axes, quantity);
  const Effort& effort = campaign->effort;
  const Cost cost = Measure(*campaign);
  const double checks = static_cast<double>(campaign->checked_pulses) *
                        SecondsOf([&] { ComputeDirectly(*campaign, CheckedPulse(*campaign, 0)); });
  const double least = cost.Of(effort.realizations) + checks;
  const double most = cost.Of(effort.most_realizations) + checks;

  PrintLine("seas and footprints", std::to_string(SeaCaseCount(*campaign)));
  PrintLine("beams of each", std::to_string(SeaCaseOf(*campaign, 0).beams.size()));
  PrintLine("cells", std::to_string(ValueCount(campaign->axes, Quantity::kThu)));
  PrintLine("checked pulses", std::to_string(campaign->checked_pulses));
  PrintLine("table in memory", absl::StrFormat("%d KiB", 2 * sizeof(float) * values / 1024));
  PrintLine("realizations", effort.most_realizations > effort.realizations
                                ? absl::StrFormat("%d to %d, by the error of each beam", effort.realizations,
                                                  effort.most_realizations)
                                : std::to_string(effort.realizations));
  PrintTimes(least, most, options.cores);
  return absl::OkStatus();
}

}  // namespace albtpu::programs
