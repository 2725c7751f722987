// The nodes of a campaign file, and the axes that they make.
#pragma once

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign_file.h"
#include "generator/campaign/traced_sea.h"
#include "sea/wave_state.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// In the order of the axes of the kind.
using Nodes = std::array<std::vector<double>, kAxisCount>;

// The sea of a file has no axes of wind and fetch. Problems are remembered by `toml`.
Nodes ReadNodesOfSea(CampaignFile& file, bool has_sea_file);
Nodes ReadNodesOfWater(CampaignFile& file);

// Checks the rules for a sea that can be simulated, and then those of all axes. InvalidArgument with the key.
absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const SpectrumModel& model, Nodes nodes);
// The same for one sea, whose axes of wind and fetch have one node.
absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const TracedSea& sea, Nodes nodes);
// The same for the water column.
absl::StatusOr<UncertaintyTable::Axes> MakeWaterAxes(const Nodes& nodes);

}  // namespace albtpu
