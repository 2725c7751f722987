#include "sea/spectra/binned_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace albtpu {

BinnedSpectrum::BinnedSpectrum(std::shared_ptr<const std::vector<double>> centres,
                               const std::vector<DirectionalEnergy>& bins, std::size_t harmonics, double trusted_up_to)
    : centres_(std::move(centres)), harmonics_(harmonics), trusted_up_to_(trusted_up_to) {
  assert(centres_->size() >= 2 && bins.size() == centres_->size() && harmonics <= kSeaHarmonics);
  assert(centres_->front() > 0 && trusted_up_to > 0);
  values_.reserve(bins.size() * (1 + 2 * harmonics));
  for (const DirectionalEnergy& bin : bins) {
    assert(bin.energy >= 0);
    values_.push_back(bin.energy);
    for (std::size_t n = 0; n < harmonics; ++n) values_.insert(values_.end(), {bin.cosine[n], bin.sine[n]});
  }
}

DirectionalEnergy BinnedSpectrum::bin(std::size_t i) const {
  const double* const values = &values_[i * (1 + 2 * harmonics_)];
  DirectionalEnergy bin{.energy = values[0]};
  for (std::size_t n = 0; n < harmonics_; ++n) {
    bin.cosine[n] = values[1 + 2 * n];
    bin.sine[n] = values[2 + 2 * n];
  }
  return bin;
}

double BinnedSpectrum::width(std::size_t i) const {
  const std::vector<double>& f = *centres_;
  if (i == 0) return f[1] - f[0];
  if (i + 1 == f.size()) return f[i] - f[i - 1];
  return 0.5 * (f[i + 1] - f[i - 1]);
}

DirectionalEnergy BinnedSpectrum::operator()(double f) const {
  const std::vector<double>& centres = *centres_;
  if (f < centres.front() || f > centres.back()) return {};
  const std::size_t right = right_of(f);
  const double t = (f - centres[right - 1]) / (centres[right] - centres[right - 1]);
  DirectionalEnergy result;
  return result.Add(bin(right - 1), 1 - t).Add(bin(right), t);
}

std::size_t BinnedSpectrum::right_of(double f) const {
  return static_cast<std::size_t>(std::lower_bound(centres_->begin() + 1, centres_->end(), f) - centres_->begin());
}

DirectionalEnergy BinnedSpectrum::Between(double below, double f, double above) const {
  const std::vector<double>& centres = *centres_;
  if (f < centres.front() || f > centres.back()) return {};
  const std::size_t right = right_of(f);
  if (!(centres[right] - centres[right - 1] < above - f)) return (*this)(f);

  std::vector<double> knots{std::max(below, centres.front()), f, std::min(above, centres.back())};
  for (const double centre : centres)
    if (centre > knots[0] && centre < knots[2] && centre != f) knots.push_back(centre);
  std::sort(knots.begin(), knots.end());
  const auto weight = [&](double at) { return at < f ? (at - below) / (f - below) : (above - at) / (above - f); };
  DirectionalEnergy sum;
  double weights = 0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (!(knots[i] > knots[i - 1])) continue;
    // Between knots both factors are linear, for which Simpson's rule is exact.
    const double middle = std::midpoint(knots[i - 1], knots[i]), width = knots[i] - knots[i - 1];
    for (const auto& [at, part] : {std::pair(knots[i - 1], 1.0), std::pair(middle, 4.0), std::pair(knots[i], 1.0)}) {
      sum.Add((*this)(at), width * part * weight(at));
      weights += width * part * weight(at);
    }
  }
  DirectionalEnergy mean;
  return mean.Add(sum, 1 / weights);
}

std::vector<double> BinnedSpectrum::ComparedFrequencies(double lowest, double highest) const {
  constexpr double kRounding = 1e-9;  // 0.75 * 0.4 is above 0.3 in double precision
  std::vector<double> compared;
  for (std::size_t i = 0; i < size(); ++i) {
    const double f = centre(i);
    if (f >= lowest * (1 - kRounding) && f <= highest * (1 + kRounding) && bin(i).energy > 0) compared.push_back(f);
  }
  return compared;
}

double BinnedSpectrum::significant_wave_height() const {
  double variance = 0;
  for (std::size_t i = 0; i < size(); ++i) variance += bin(i).energy * width(i);
  return 4 * std::sqrt(variance);
}

DirectionalEnergy BinnedSpectrum::peak() const {
  std::size_t peak = 0;
  for (std::size_t i = 1; i < size(); ++i)
    if (bin(i).energy > bin(peak).energy) peak = i;
  return bin(peak);
}

double BinnedSpectrum::leading_axis() const { return peak().PrincipalAxis(); }

std::optional<double> BinnedSpectrum::ShortWaveAxis(double f) const {
  DirectionalEnergy sum;
  for (const double centre : ComparedFrequencies(0.75 * f, f)) sum.Add((*this)(centre));
  if (!(sum.energy > 0)) sum = peak();
  return sum.IsIsotropic() ? std::nullopt : std::optional(sum.PrincipalAxis());
}

double BinnedSpectrum::isotropic_share() const {
  double all = 0, isotropic = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double variance = bin(i).energy * width(i);
    all += variance;
    if (bin(i).IsIsotropic()) isotropic += variance;
  }
  return all > 0 ? isotropic / all : 0;
}

}  // namespace albtpu
