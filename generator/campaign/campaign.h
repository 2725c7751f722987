// A campaign: what a table is to hold and with what effort, as its TOML file says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/beam.h"
#include "sea/sea_state.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Example of a file, in the units of tables/schema.h; `seed`, `[beam]`, `[water]`, `[sea]` and `[effort]`, or
// any key of these, may be left out:
//
//   id = "bay"
//   version = "1"
//   title = "A bay, light winds"
//   seed = 1
//   [axes]
//   wind_speed = [3, 5, 7]
//   fetch = [1000, 10000, inf]    # the last one must be inf: fully developed
//   incidence = [0, 10, 20]
//   azimuth = [0, 45, 90]
//   footprint = [0.25, 0.5, 1]
//   depth = [0, 1, 20]
//   [beam]
//   profile = "uniform"           # or "gaussian"
//   source_height = inf           # m; inf: collimated
//   [water]
//   refractive_index = 1.33
//   [sea]
//   spectrum = "apel"             # or "elfouhaily"
//   spreading = 2                 # s of the cosine-2S spreading, of Apel's sea only
//   corrected_above = inf         # m; longer waves are corrected for by the local slope and left out
//   [effort]
//   realizations = 1000
//   most_realizations = 40000     # the end even where relative_error is not met
//   relative_error = 0.02         # go on until every value has it; absent: `realizations` it is
//   estimator = "control_variate" # or "plain": tracing alone
//   rays = 10000                  # of each beam; chosen from spectrum and footprint where absent
//   [interpolation]
//   nodes = "exact"               # or "balanced": see node_balance.h
//   checked_pulses = 40           # between the nodes, at which the table is held to direct computation
struct Campaign {
  std::string text;  // the file, as it is
  std::string id, version, title;
  std::uint64_t seed = 1;
  UncertaintyTable::Axes axes;  // the last fetch already resolved: the least that is `inf` for all winds
  BeamProfile profile = BeamProfile::kUniform;
  double source_height = std::numeric_limits<double>::infinity();
  double refractive_index = 1.33;
  WindSea wind_sea;                                                  // wind and fetch aside, which are axes
  double corrected_above = std::numeric_limits<double>::infinity();  // m
  Effort effort;
  std::optional<int> rays;
  bool balanced_nodes = false;      // see node_balance.h
  std::size_t checked_pulses = 40;  // see interpolation_check.h

  const std::vector<double>& nodes(AxisId axis) const { return axes[Index(axis)].nodes(); }
};

// InvalidArgument, naming the key and what would be right: text that is not TOML (with its line), an unknown
// or a missing key, a value of another type or out of its range, nodes that do not make an axis.
absl::StatusOr<Campaign> ParseCampaign(std::string_view toml);

// The same from a file. NotFound when there is none; messages begin with the path.
absl::StatusOr<Campaign> ReadCampaign(const std::filesystem::path& path);

// The cell of the random numbers (random_stream.h) of every sea case and every checked pulse of a table. The
// same for all: what chance does to one node it does to its neighbours, so that a table is smoother than its
// standard errors, which are those of each value by itself.
inline constexpr std::uint32_t kCellOfTables = 0;

// A campaign is worked off in sea cases: seas and footprints, each with all incidences, azimuths and depths.
// Their order is wind, fetch, footprint, the last fastest.
std::size_t SeaCaseCount(const Campaign& campaign);
SeaCase SeaCaseOf(const Campaign& campaign, std::size_t index);

// The campaign's sea at a wind [m/s] and a fetch [m].
SeaOptions SeaOf(const Campaign& campaign, double wind_speed, double fetch);

}  // namespace albtpu
