#include "sea/files/spectral_grid.h"

#include <cassert>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/files/sea_limits.h"

namespace albtpu {

SpectralGrid::SpectralGrid(std::vector<double> frequencies, std::vector<double> directions)
    : frequencies_(std::make_shared<const std::vector<double>>(std::move(frequencies))),
      bins_(std::move(directions)) {}

absl::StatusOr<SpectralGrid> SpectralGrid::Make(std::vector<double> frequencies,
                                                std::vector<double> directions) {
  if (frequencies.size() < 2 || directions.size() < DirectionalBins::kFewest)
    return absl::InvalidArgumentError(absl::StrCat(
        "the spectra have ", frequencies.size(), " frequencies and ", directions.size(),
        " directions (expected at least 2 and ", DirectionalBins::kFewest, "); write them with more"));
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const bool increases = i == 0 || frequencies[i] > frequencies[i - 1];
    if (!(increases && frequencies[i] >= kLowestFrequency && frequencies[i] <= kHighestFrequency))
      return absl::InvalidArgumentError(
          absl::StrCat("frequency ", i + 1, " is ", frequencies[i], " Hz (expected ", kLowestFrequency,
                       " to ", kHighestFrequency, " Hz, increasing); get another copy of the file"));
  }
  return SpectralGrid(std::move(frequencies), std::move(directions));
}

absl::StatusOr<BinnedWaves> SpectralGrid::WavesOf(std::span<const double> densities, Order order) const {
  assert(densities.size() == size());
  const std::size_t f_count = frequencies_->size(), d_count = bins_.size();
  std::vector<DirectionalEnergy> energies;
  std::vector<double> at_f(d_count);
  for (std::size_t f = 0; f < f_count; ++f) {
    for (std::size_t d = 0; d < d_count; ++d) {
      at_f[d] = densities[order == Order::kFrequencyFirst ? d * f_count + f : f * d_count + d];
      if (!(at_f[d] >= 0 && at_f[d] <= kMaxDensity))
        return absl::InvalidArgumentError(absl::StrCat("the spectrum that ends here has a density of ",
                                                       at_f[d], " m2/Hz/rad (expected 0 to ", kMaxDensity,
                                                       "); get another copy of the file"));
    }
    energies.push_back(bins_.Sum(at_f));
  }
  return std::make_shared<const BinnedSpectrum>(frequencies_, energies, bins_.harmonics(),
                                                frequencies_->back());
}

BinnedWaves SpectralGrid::NoWaves() const {
  return std::make_shared<const BinnedSpectrum>(
      frequencies_, std::vector<DirectionalEnergy>(frequencies_->size()), 0, frequencies_->back());
}

}  // namespace albtpu
