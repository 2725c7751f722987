#include "sea/spectra/sea_error.h"

#include <cmath>
#include <utility>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/spectral_tail.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

double WeightedSlopeVariance(HarmonicSpectrum spectrum, const std::function<double(double k)>& weight) {
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum.s[i] *= weight(spectrum.k[i]);
  return MeanSquareSlope(spectrum);
}

HarmonicSpectrum WithTail(SeaDescription description, TailRule rule) {
  description.tail = rule;
  return Describe(description).spectrum;
}

}  // namespace

SeaErrors::SeaErrors(const SeaDescription& description, double record_length) {
  DescribedSea sea = Describe(description);
  if (const auto* bins = dynamic_cast<const BinnedSpectrum*>(description.waves.get())) {
    for (std::size_t i = 0; i < bins->size(); ++i) {
      const double k = WavenumberOfFrequency(bins->centre(i), sea.water_depth);
      const double resolved = 1 - TailWeight(k, sea.cutoff);
      bins_.push_back({.k = k,
                       .slope_variance = k * k * resolved * bins->bin(i).energy * bins->width(i),
                       .relative_variance = 1 / (bins->width(i) * record_length)});
    }
  }
  if (description.waves && description.tail != TailRule::kNone && sea.wind_speed_10m > 0) {
    with_wind_tail_ = WithTail(description, TailRule::kWind);
    with_level_tail_ = WithTail(description, TailRule::kLevel);
  }
  spectrum_ = std::move(sea.spectrum);
}

SeaError SeaErrors::operator()(const std::function<double(double k)>& weight) const {
  SeaError error;
  const double v = WeightedSlopeVariance(spectrum_, weight);
  if (!(v > 0)) return error;
  double sampling = 0;  // the variance of V that comes from the bins
  for (const Bin& bin : bins_) sampling += bin.relative_variance * std::pow(weight(bin.k) * bin.slope_variance, 2);
  error.sampling = std::sqrt(sampling) / v;
  if (with_wind_tail_) {
    error.tail =
        0.5 / v *
        std::abs(WeightedSlopeVariance(*with_wind_tail_, weight) - WeightedSlopeVariance(*with_level_tail_, weight));
  }
  error.total = std::hypot(error.sampling, error.tail);
  return error;
}

SeaError ErrorOfSea(const SeaDescription& description, double record_length,
                    const std::function<double(double k)>& weight) {
  return SeaErrors(description, record_length)(weight);
}

}  // namespace albtpu
