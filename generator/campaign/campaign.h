// A campaign: the contents of a table and the effort of its computation, from a TOML file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign_axes.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/beam.h"
#include "sea/sea_state.h"
#include "sea/water_index.h"
#include "tables/uncertainty_table.h"
#include "tables/water/water_schema.h"

namespace albtpu {

// The settings of a table of the water column, in place of a sea.
struct WaterWork {
  double group_index = kSeaWaterGroupIndex;
  std::uint32_t photons = 60'000;  // of each pool
  int pairs_per_photon = 3;
};

// The keys of the file are in campaign_keys.h, and for people in docs/campaign.md.
struct Campaign {
  std::string text;  // the whole file
  std::string id, version, title;
  std::uint64_t seed = 1;
  // Of `kind`; the last fetch, `inf` in the file, is the shortest at which all winds are fully developed.
  UncertaintyTable::Axes axes;
  BeamProfile profile = BeamProfile::kUniform;
  double source_height = std::numeric_limits<double>::infinity();
  double refractive_index = kRefractiveIndex;
  WindSea wind_sea;  // without wind and fetch, which are axes
  // In its place, of a table of the water column (water_cases.h).
  std::optional<WaterWork> water;
  double corrected_above = std::numeric_limits<double>::infinity();  // m
  Effort effort;
  std::optional<int> rays;
  bool balanced_nodes = false;      // see table_maker.h
  std::size_t checked_pulses = 40;  // see provenance.h

  const TableSchema& kind() const { return water ? kWaterColumn : kSeaSurface; }
  // Of a sea.
  const std::vector<double>& nodes(AxisId axis) const { return axes[Index(axis)].nodes(); }
};

// InvalidArgument, with the key and the values that it takes, for text that is not TOML (with its line), an unknown
// or a missing key, a value of another type or out of range, and nodes that do not make an axis.
absl::StatusOr<Campaign> ParseCampaign(std::string_view toml);

// The same from a file. NotFound if there is none; messages begin with the path.
absl::StatusOr<Campaign> ReadCampaign(const std::filesystem::path& path);

// The cell of the random numbers (random_stream.h) of every sea case and every checked pulse of a table. It is the
// same for all, so the random errors of neighbouring nodes are nearly equal and a table is smoother than its standard
// errors, which are those of each value by itself.
inline constexpr std::uint32_t kCellOfTables = 0;

// A campaign of a sea is computed in sea cases: one sea and one footprint, with all incidences, azimuths and depths.
// They are ordered by wind, fetch and footprint, which varies fastest.
std::size_t SeaCaseCount(const Campaign& campaign);
SeaCase SeaCaseOf(const Campaign& campaign, std::size_t index);

// The campaign's sea at a wind [m/s] and a fetch [m].
SeaOptions SeaOf(const Campaign& campaign, double wind_speed, double fetch);

}  // namespace albtpu
