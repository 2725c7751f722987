// The sea of a file for tracing, and the nodes of a campaign file with the axes that they make.
#pragma once

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign_file.h"
#include "sea/sea_state.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// In the order of the axes of the kind.
using Nodes = std::array<std::vector<double>, kAxisCount>;

// Problems are remembered by `file`.
Nodes ReadNodesOfSea(CampaignFile& file);
Nodes ReadNodesOfWater(CampaignFile& file);

// The axes of these nodes, in the order of the kind. InvalidArgument if some nodes make no axis.
absl::StatusOr<UncertaintyTable::Axes> AxesOfKind(const TableSchema& kind, const Nodes& nodes);

// Checks the rules for a sea that can be simulated, and then those of all axes. InvalidArgument with the key.
absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const SpectrumModel& model, Nodes nodes);
// The same for the water column.
absl::StatusOr<UncertaintyTable::Axes> MakeWaterAxes(const Nodes& nodes);

}  // namespace albtpu
