// The contents of a file of the sea: its states at times and places, measured or computed.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/spectra/jonswap.h"

namespace albtpu {

using BinnedWaves = std::shared_ptr<const BinnedSpectrum>;
using WaveComponents = std::shared_ptr<const std::vector<JonswapWaves>>;  // at least one
using WholeSea = std::shared_ptr<const HarmonicSpectrum>;
using WindAlone = std::monostate;  // the sea is the fully developed one of the wind, which is known with its direction

struct SeaRecord {
  std::optional<double> time = {};            // s since 1970-01-01T00:00:00Z, without leap seconds
  std::size_t point = 0;                      // of SeaSeries::points
  std::optional<double> water_depth = {};     // m
  std::optional<double> wind_speed_10m = {};  // m/s
  std::optional<double> wind_from = {};       // compass direction, rad
  std::variant<BinnedWaves, WaveComponents, WholeSea, WindAlone> waves = {};

  double significant_wave_height() const;  // m
};

struct SeaPoint {
  std::string name;                                     // may be empty
  std::optional<double> latitude = {}, longitude = {};  // degrees
};

struct SeaSeries {
  std::string format;  // "an NDBC file of spectra", for messages
  std::vector<SeaPoint> points = {{}};
  std::vector<SeaRecord> records = {};                             // at least one; times increase at each point
  std::vector<std::string> assumed = {};                           // sentences: what was assumed and what was left out
  double record_length = std::numeric_limits<double>::infinity();  // s, of a measurement; infinity for models
};

// The sea of a record. A number of `given` takes precedence over that of the record; the `waves` of `given` are not
// used.
DescribedSea Describe(const SeaRecord& record, SeaDescription given = {});

// The description of that sea. Not for a WholeSea, which is complete.
SeaDescription DescriptionOf(const SeaRecord& record, SeaDescription given = {});

// States in `assumed` how many records have bins without direction. `what` is missing there: "r2 or alpha2".
void NoteIsotropic(SeaSeries& series, std::string_view what);

// Sorts records by point and time. Of records for the same point and time the first one stays; `assumed` says so.
void SortByTime(SeaSeries& series);

}  // namespace albtpu
