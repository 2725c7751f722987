// A described sea: everything that determines its table.
#pragma once

#include <limits>
#include <optional>
#include <variant>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"
#include "sea/spectra/described_sea.h"
#include "sea/water_index.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

class SeaCompiler;

// In the same water, equal seas have the same table in process, on a server and from a file, bit for bit on the same
// instruction set.
struct KnownSea {
  // Without waves the sea is the fully developed sea of the wind. A WholeSea is complete: the wind's direction is its x
  // axis, wind speed and depth are only stated, and the other members have no effect.
  std::variant<std::monostate, BinnedWaves, WaveComponents, WholeSea> waves = {};
  std::optional<double> wind_speed_10m = {};  // m/s, from 0
  std::optional<double> wind_from = {};       // compass direction, rad
  std::optional<double> water_depth = {};     // m, above 0
  TailRule tail = TailRule::kRelax;
  std::optional<double> tail_from = {};                            // Hz, above 0
  double record_length = std::numeric_limits<double>::infinity();  // s, of measured waves; infinity for others
};

// The sea of a record. A number of `given` takes precedence over that of the record; the `waves` of `given` are not
// used.
KnownSea KnownSeaOf(const SeaRecord& record, const SeaDescription& given, double record_length);

// Its spectrum, with the assumptions made.
DescribedSea Describe(const KnownSea& sea);

// The table of the sea in water of `index`. InvalidArgument if it is steeper than any sea (sea_table.h), or if a table
// cannot hold its numbers.
absl::StatusOr<UncertaintyTable> CompileSea(const SeaCompiler& compiler, const KnownSea& sea,
                                            double index = kSeaWaterIndex);

}  // namespace albtpu
