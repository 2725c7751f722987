// A first pass over the points of a LAS file, which collects what annotation needs in advance: the water surface, the
// extent of the points in space and time, and pairs of returns from which the direction of a beam follows.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/beams/file_track.h"
#include "budget/beams/return_pair.h"
#include "budget/beams/terrain_planes.h"
#include "budget/beams/water_surface.h"
#include "formats/clocks/time_tally.h"
#include "formats/las/header_bounds.h"
#include "formats/las/las_reader.h"

namespace albtpu::annotate {

struct LasPrescanOptions {
  std::set<int> classes;              // Of the chosen points.
  std::set<int> water_classes;        // Of returns from the water surface.
  bool pairs = false;                 // Look for pairs; needs GPS times.
  std::optional<double> water_level;  // In the file's unit: returns above its waves make no pair.
  std::set<int> level_classes = {};   // Of returns that should lie at the water level.
  bool use_withheld = false;          // Points with this flag count as any other.
  bool dry_points = false;            // Points that may be dry (MayBeDry) get a number, too.
  double seconds = 1;                 // Of a unit of the times, for `surface`.
  bool terrain = false;               // Find the planes of the ground.
};

// Records in a file in order of time that belong to one pulse lie at most this far apart.
inline constexpr std::size_t kPulseReach = 16;

// m; in waves of Hs 6 m, three returns in four are nearer to the level than this.
inline constexpr double kLevelTolerance = 2;

struct LasPrescan {
  formats::LasBounds all;      // Of all points.
  std::uint64_t numbered = 0;  // Points that may get a number: chosen and dry ones.
  formats::LasBounds of_numbered;
  // Of the same points, those that are times (formats::IsNoTime).
  double first_time = std::numeric_limits<double>::infinity(), last_time = -first_time;
  formats::TimeTally tally;                                  // Of the same times; pulses where pairs are wanted.
  std::uint64_t surface_returns = 0, synthetic_surface = 0;  // The latter are part of the former.
  // Returns of `level_classes`, those of them that lie farther than kLevelTolerance from the water level, and the mean
  // height [m] of these.
  std::uint64_t level_returns = 0, off_level = 0;
  double off_level_height = 0;
  std::optional<LocalWaterSurface> surface;  // If there are surface returns.
  // If wanted: of the ground (IsGround), or of unclassified points where nothing is classified as ground.
  std::optional<TerrainPlanes> terrain;
  bool terrain_is_classified = false;
  // Two returns of one pulse at least 1 m apart, the lower one of a chosen class, neither of them noise or of the
  // surface or synthetic: a sample in order of time.
  std::vector<ReturnPair> pairs;
  std::uint64_t pair_count = 0;  // Of which `pairs` is a sample.
  // Returns of pulses with several returns, and those of them that have no other one of their pulse within reach.
  // Pairs beyond that reach are found by their times (pulse_sample.h).
  std::uint64_t of_several = 0, alone = 0;

  // Most returns of a pulse do not lie side by side: the file is sorted by place, or some were left out.
  bool is_scattered() const { return 2 * alone > of_several; }
};

// Memory does not grow with the number of points. The result does not depend on the number of threads.
absl::StatusOr<LasPrescan> Prescan(const formats::LasReader& reader, const formats::LocalFrame& frame,
                                   const LasPrescanOptions& options);

}  // namespace albtpu::annotate
