// A spectrum in bins of frequency, as buoys measure it and wave models write it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// E, E cos(2 n c) and E sin(2 n c) are linear in f between the centres of bins, 0 below the first and above the last.
class BinnedSpectrum final : public FrequencySpectrum {
 public:
  // `centres` [Hz] are above 0 and increase, at least two; all records of a file share them. `bins` has as many
  // entries, of which the first `harmonics` harmonics are kept.
  BinnedSpectrum(std::shared_ptr<const std::vector<double>> centres, const std::vector<DirectionalEnergy>& bins,
                 std::size_t harmonics, double trusted_up_to);

  std::size_t size() const { return centres_->size(); }
  double centre(std::size_t i) const { return (*centres_)[i]; }
  DirectionalEnergy bin(std::size_t i) const;

  // Hz: to half way to the neighbours, the ends symmetric.
  double width(std::size_t i) const;

  DirectionalEnergy operator()(double f) const override;
  // A weighted mean where the centres are closer together than f and `above`. The weights rise from `below` to f and
  // fall to `above`. Only frequencies between the first and the last centre count.
  DirectionalEnergy Between(double below, double f, double above) const override;
  double highest_frequency() const override { return centres_->back(); }
  // The centres of bins with energy: instruments round little energy to 0.
  std::vector<double> ComparedFrequencies(double lowest, double highest) const override;
  double trusted_up_to() const override { return trusted_up_to_; }
  double significant_wave_height() const override;
  double leading_axis() const override;
  std::optional<double> ShortWaveAxis(double f) const override;
  // The share of the variance in bins that have no direction.
  double isotropic_share() const;

 private:
  DirectionalEnergy peak() const;  // The bin of the most energy.
  // The centre at or above `f`, from the second one; `f` is between the first and the last.
  std::size_t right_of(double f) const;

  std::shared_ptr<const std::vector<double>> centres_;
  std::size_t harmonics_;
  std::vector<double> values_;  // of each bin: energy, then cosine and sine of each harmonic
  double trusted_up_to_;
};

}  // namespace albtpu
