#include "sea/spectra/sea_error.h"

#include <cmath>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/dispersion.h"
#include "sea/spectra/spectral_tail.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

double WeightedSlopeVariance(HarmonicSpectrum spectrum, const std::function<double(double k)>& weight) {
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum.s[i] *= weight(spectrum.k[i]);
  return MeanSquareSlope(spectrum);
}

double VarianceWithTail(SeaDescription description, TailRule rule,
                        const std::function<double(double k)>& weight) {
  description.tail = rule;
  return WeightedSlopeVariance(Describe(description).spectrum, weight);
}

// The variance of V that comes from the bins.
double SamplingVariance(const BinnedSpectrum& bins, const DescribedSea& sea, double record_length,
                        const std::function<double(double k)>& weight) {
  double sum = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double k = WavenumberOfFrequency(bins.centre(i), sea.water_depth);
    const double resolved = 1 - TailWeight(k, sea.cutoff);
    const double v = weight(k) * k * k * resolved * bins.bin(i).energy * bins.width(i);
    sum += v * v / (bins.width(i) * record_length);  // 2 / nu
  }
  return sum;
}

}  // namespace

SeaError ErrorOfSea(const SeaDescription& description, double record_length,
                    const std::function<double(double k)>& weight) {
  SeaError error;
  const DescribedSea sea = Describe(description);
  const double v = WeightedSlopeVariance(sea.spectrum, weight);
  if (!(v > 0)) return error;
  if (const auto* bins = dynamic_cast<const BinnedSpectrum*>(description.waves.get()))
    error.sampling = std::sqrt(SamplingVariance(*bins, sea, record_length, weight)) / v;
  if (description.waves && description.tail != TailRule::kNone && sea.wind_speed_10m > 0) {
    error.tail = 0.5 / v *
                 std::abs(VarianceWithTail(description, TailRule::kWind, weight) -
                          VarianceWithTail(description, TailRule::kLevel, weight));
  }
  error.total = std::hypot(error.sampling, error.tail);
  return error;
}

}  // namespace albtpu
