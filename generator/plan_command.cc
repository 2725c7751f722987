#include <algorithm>
#include <chrono>
#include <iostream>

#include "generator/campaign.h"
#include "generator/commands.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Cells and bytes are counted; the time comes from a few realizations of a few encounters spread over the
// campaign.
absl::Status RunPlan(const PlanOptions& options) {
  const absl::StatusOr<Campaign> campaign = ReadCampaign(options.campaign);
  if (!campaign.ok()) return campaign.status();

  std::size_t values = 0;
  for (const Quantity quantity : kQuantities) values += ValueCount(campaign->axes, quantity);
  const std::size_t encounters = EncounterCount(*campaign);
  const std::size_t beams = EncounterOf(*campaign, 0).beams.size();

  constexpr std::size_t kProbes = 12;
  constexpr int kRealizations = 16;
  const Effort probe{.realizations = kRealizations, .most_realizations = kRealizations, .relative_error = 0};
  const std::size_t probes = std::min(kProbes, encounters);
  double seconds_per_realization = 0;
  for (std::size_t p = 0; p < probes; ++p) {
    const Encounter encounter = EncounterOf(*campaign, (2 * p + 1) * encounters / (2 * probes));
    const auto start = std::chrono::steady_clock::now();
    Simulate(encounter, probe, campaign->seed, static_cast<std::uint32_t>(p));
    seconds_per_realization +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kRealizations /
        static_cast<double>(probes);
  }
  const double least =
      seconds_per_realization * static_cast<double>(encounters) * campaign->effort.realizations;

  std::cout << "campaign                " << campaign->id << ", version " << campaign->version << '\n'
            << "seas and footprints     " << encounters << '\n'
            << "beams of each           " << beams << '\n'
            << "cells                   " << ValueCount(campaign->axes, Quantity::kThu) << '\n'
            << "table in memory         " << 2 * sizeof(float) * values / 1024 << " KiB\n"
            << "realizations, at least  " << campaign->effort.realizations << '\n'
            << "time, at least          " << static_cast<int>(least + 0.5) << " s on this machine\n";
  if (campaign->effort.most_realizations > campaign->effort.realizations) {
    std::cout << "time, at most           "
              << static_cast<int>(least * campaign->effort.most_realizations / campaign->effort.realizations +
                                  0.5)
              << " s, if no cell met its relative error before\n";
  }
  return absl::OkStatus();
}

}  // namespace albtpu
