// Campaigns of the water column: their cases, and the table of the results.
#pragma once

#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/math/statistics.h"
#include "tables/table.h"
#include "tables/water/water_column_table.h"

namespace albtpu {

// A water case is one phase function, one ratio of scattering to absorption and one incidence, which share their
// photons, with all optical depths, fields of view and pulses. They are ordered as the axes of the table.
std::size_t WaterCaseCount(const Campaign& campaign);

// The results of a case, in the order of optical depths, then fields of view: the quantities over all axes of one pulse
// after the other, and then those over all but pulses, in the order of WaterQuantity. An echo that has no end within
// its times has standard errors of infinity. Runs on all threads of the current TBB arena.
std::vector<Estimate> ComputeWaterCase(const Campaign& campaign, std::size_t index);

// A random water, depth and system: those of coastal surveys, within the table. All numbers are of one seed.
struct CheckedBeam {
  double backscatter_fraction = 0, scattering_over_absorption = 0;
  double depth = 0;  // m
  WaterBeam beam;
};
CheckedBeam CheckedBeamOf(const Campaign& campaign, std::size_t index);

// The biases of a checked beam in m, by the random numbers of the table's cases: vertical and along, each by Detector;
// and the energy of its echo.
std::vector<Estimate> ComputeDirectly(const Campaign& campaign, const CheckedBeam& checked);
inline constexpr std::size_t kCheckedBiases = 6, kCheckedEstimates = kCheckedBiases + 1;

// `cases` and `direct` are what the functions above return for all indices. DataLoss if one has another size.
absl::StatusOr<Table> BuildWaterTable(const Campaign& campaign, const std::vector<std::vector<Estimate>>& cases,
                                      const std::vector<std::vector<Estimate>>& direct);

}  // namespace albtpu
