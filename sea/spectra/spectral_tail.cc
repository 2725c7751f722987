#include "sea/spectra/spectral_tail.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

constexpr TailRule kTailRules[] = {TailRule::kWind, TailRule::kRelax, TailRule::kLevel, TailRule::kNone};

}  // namespace

std::string_view Name(TailRule rule) {
  switch (rule) {
    case TailRule::kWind:
      return "wind";
    case TailRule::kRelax:
      return "relax";
    case TailRule::kLevel:
      return "level";
    case TailRule::kNone:
      break;
  }
  return "none";
}

std::optional<TailRule> FindTailRule(std::string_view name) {
  for (const TailRule rule : kTailRules)
    if (name == Name(rule)) return rule;
  return std::nullopt;
}

double TailWeight(double k, double cutoff) {
  constexpr double kWidth = 0.15;  // in ln k
  return 0.5 * (1 + std::tanh(std::log(k / cutoff) / kWidth));
}

double LevelPower(TailRule rule, double k, double cutoff) {
  switch (rule) {
    case TailRule::kRelax:
      return std::max(0.0, 1 - std::log10(k / cutoff));
    case TailRule::kLevel:
      return 1;
    case TailRule::kWind:
    case TailRule::kNone:
      return 0;
  }
  return 0;
}

HarmonicSpectrum WindWaves(const ElfouhailySpectrum& wind, const std::vector<double>& wavenumbers) {
  HarmonicSpectrum waves = FlatSea(wavenumbers, kSeaHarmonics);
  for (std::size_t i = 0; i < wavenumbers.size(); ++i) {
    waves.s[i] = wind(wavenumbers[i]);
    waves.a[0][i] = wind.Delta(wavenumbers[i]) / 2;  // Eq. 49: D = (1 + Delta cos(2 psi)) / (2 pi)
  }
  return waves;
}

TailLevel LevelAtCutoff(const FrequencySpectrum& resolved, const ElfouhailySpectrum& wind, double depth,
                        double tail_from) {
  assert(tail_from > 0);
  TailLevel level;
  double sum = 0;
  for (const double f : resolved.ComparedFrequencies(0.75 * tail_from, tail_from)) {
    const double k = WavenumberOfFrequency(f, depth);
    const double s_resolved = resolved(f).energy * FrequencySlope(k, depth), s_wind = wind(k);
    if (!(s_resolved > 0 && s_wind > 0)) continue;
    sum += std::log(s_resolved / s_wind);
    ++level.compared;
  }
  if (level.compared == 0) return level;
  const double mean = std::exp(sum / level.compared);
  level.q = std::clamp(mean, 0.5, 2.0);
  level.held = level.q != mean;
  return level;
}

}  // namespace albtpu
