// The frequencies and directions of a model's spectra.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "sea/files/directional_bins.h"
#include "sea/files/sea_series.h"

namespace albtpu {

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

}  // namespace albtpu
