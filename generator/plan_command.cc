#include <algorithm>
#include <chrono>
#include <iostream>

#include "generator/campaign.h"
#include "generator/commands.h"
#include "tables/uncertainty_table.h"

namespace albtpu {
namespace {

double SecondsOf(const Encounter& encounter, int realizations) {
  const Effort effort{.realizations = realizations, .most_realizations = realizations, .relative_error = 0};
  const auto start = std::chrono::steady_clock::now();
  Simulate(encounter, effort, 1, 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

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
  const std::size_t probes = std::min(kProbes, encounters);
  double setup = 0, per_realization = 0;  // s, sums over the probes
  for (std::size_t p = 0; p < probes; ++p) {
    const Encounter encounter = EncounterOf(*campaign, (2 * p + 1) * encounters / (2 * probes));
    const double few = SecondsOf(encounter, 4), more = SecondsOf(encounter, 24);
    per_realization += std::max(0.0, more - few) / 20;
    setup += std::max(0.0, few - (more - few) / 5);
  }
  const double encounters_per_probe = static_cast<double>(encounters) / static_cast<double>(probes);
  const auto seconds = [&](int realizations) {
    return static_cast<int>(encounters_per_probe * (setup + realizations * per_realization) + 0.5);
  };

  std::cout << "campaign                " << campaign->id << ", version " << campaign->version << '\n'
            << "seas and footprints     " << encounters << '\n'
            << "beams of each           " << beams << '\n'
            << "cells                   " << ValueCount(campaign->axes, Quantity::kThu) << '\n'
            << "table in memory         " << 2 * sizeof(float) * values / 1024 << " KiB\n"
            << "realizations, at least  " << campaign->effort.realizations << '\n'
            << "time, at least          " << seconds(campaign->effort.realizations) << " s on this machine\n";
  if (campaign->effort.most_realizations > campaign->effort.realizations) {
    std::cout << "time, at most           " << seconds(campaign->effort.most_realizations)
              << " s, if no cell met its relative error before\n";
  }
  return absl::OkStatus();
}

}  // namespace albtpu
