// The sea of a file for tracing, and the nodes of a campaign file with the axes that they make.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign_file.h"
#include "sea/sea_state.h"
#include "sea/spectra/described_sea.h"
#include "tables/provenance.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// A sea from a file for tracing: the settings of the user, and the sea that was read.

// Directions are of the compass, in degrees. Absent members are taken from the file or assumed (described_sea.h).
struct SeaOfFile {
  std::filesystem::path file;       // of any kind that ReadSeaFile takes
  std::optional<std::string> time;  // UTC, as 2020-06-08T03:50Z; not needed if the file has one state
  std::optional<double> water_depth, wind_speed, wind_from;  // m; m/s at 10 m; degree
  TailRule tail = TailRule::kRelax;
  std::optional<double> tail_from;  // Hz
};

struct TracedSea {
  DescribedSea described;
  KnownWaves waves;                                  // in the frame of `described`
  std::map<std::string, AttributeValue> attributes;  // sea_attributes.h, and the name of the file and the time
  std::string digest;                                // SHA-256 of the spectrum: equal digests give equal results
};

// NotFound or InvalidArgument, beginning with the path: the file cannot be read, has several places, or has no state of
// this time.
absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given);

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
