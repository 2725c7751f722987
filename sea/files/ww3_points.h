// Spectra at points from WAVEWATCH III's point output, and the grid and the bins of direction of a model's spectra.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"
#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// From densities in bins of direction to even harmonics.

class DirectionalBins {
 public:
  static constexpr std::size_t kFewest = 8;

  // The bins' compass directions [rad] in any order, at least kFewest. Bins count as equally wide if all gaps between
  // directions are within 10 % of their mean, because WAVEWATCH III rounds directions to 0.01 rad. Otherwise a bin
  // reaches half way to its neighbours. A gap of more than twice the median is the end of a sector, at which a bin
  // reaches as far as on its other side.
  explicit DirectionalBins(std::vector<double> directions);

  // The number of harmonics 2 n, those with n below a quarter of the number of bins, which bins resolve wherever the
  // first one is. At most kSeaHarmonics.
  std::size_t harmonics() const { return harmonics_; }
  std::size_t size() const { return weights_.size(); }

  // Of densities per rad [m^2/Hz/rad], one for each direction.
  DirectionalEnergy Sum(std::span<const double> densities) const;

 private:
  std::size_t harmonics_;
  std::vector<DirectionalEnergy> weights_;  // of a density of 1 in each bin
};

// The frequencies and directions of a model's spectra.

class SpectralGrid {
 public:
  // The index that varies fastest in a list of densities.
  enum class Order { kFrequencyFirst, kDirectionFirst };

  // Frequencies [Hz] increase, at least two; directions [rad] of the compass, at least DirectionalBins::kFewest.
  static absl::StatusOr<SpectralGrid> Make(std::vector<double> frequencies, std::vector<double> directions);

  std::size_t size() const { return frequencies_->size() * bins_.size(); }

  // The waves of densities per rad, size() of them, none negative.
  absl::StatusOr<BinnedWaves> WavesOf(std::span<const double> densities, Order order) const;

  BinnedWaves NoWaves() const;

 private:
  SpectralGrid(std::vector<double> frequencies, std::vector<double> directions);

  std::shared_ptr<const std::vector<double>> frequencies_;
  DirectionalBins bins_;
};

// Spectra at points as WAVEWATCH III's point output (ww3_outp, type 1, transfer file) writes them:
//
//     'WAVEWATCH III SPECTRA'     50    36     1 'spectral resolution for points'
//      0.350E-01 0.375E-01 ...                  frequencies, Hz
//       0.148E+01  0.131E+01 ...                directions towards which waves travel, compass, rad
//     20220912 060000
//     '44097     '  40.98 -71.12      46.6   1.45 225.6   0.18  94.1
//       0.261E-17  0.551E-18 ...                m^2/Hz/rad, frequency after frequency for each direction
//
// The line of a point has its name, latitude and longitude, depth [m], wind speed at 10 m [m/s] and the direction from
// which the wind comes [degrees], speed and direction of the current, which are left out. Columns of fixed width may
// touch: "40.98-171.12".
//
// Source: the manual of WAVEWATCH III, "Point output post-processor".
bool IsWw3Points(std::string_view first_line);

absl::StatusOr<SeaSeries> ReadWw3Points(std::string_view text);

}  // namespace albtpu
