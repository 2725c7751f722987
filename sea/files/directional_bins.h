// From densities in bins of direction to even harmonics.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

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

}  // namespace albtpu
