#include "generator/water/water_column.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace albtpu {
namespace {

// Excess of paths, in units of 1 / a, beyond which absorption has left a millionth of the light.
constexpr double kAbsorbed = 14;
// Of fields of view over the depth.
constexpr double kNarrow = 0.25;

EchoSetup SetupOf(const WaterColumn& column, std::span<const double> pulse_lengths, int pairs_per_photon) {
  return {.incidence = column.incidence,
          .refracted = RefractedAngle(column.incidence, column.refractive_index),
          .group_index = column.group_index,
          .absorption = column.absorption,
          .footprint = column.footprint,
          .field_of_view = column.field_of_view,
          .step = *std::min_element(pulse_lengths.begin(), pulse_lengths.end()) / 30,
          .pairs_per_photon = pairs_per_photon};
}

double SpotOf(const Echo& echo) {
  const double mean = echo.ahead / echo.energy;
  return std::sqrt(std::max(0.0, echo.ahead_squared / echo.energy - mean * mean));
}

}  // namespace

double RefractedAngle(double incidence, double refractive_index) {
  return std::asin(std::sin(incidence) / refractive_index);
}

WaterColumnBias BiasOfEchoes(std::span<const Echo> pools, const WaterColumn& column,
                             std::span<const double> pulse_lengths) {
  Echo all = pools.front();
  for (const Echo& pool : pools.subspan(1)) all += pool;
  // Values from the sum of all pools. Their standard errors are by jackknife: values without one pool each.
  std::vector<Echo> without;
  for (const Echo& pool : pools) {
    Echo rest = pool;
    rest *= -1;
    rest += all;
    without.push_back(std::move(rest));
  }
  const auto count = static_cast<double>(pools.size());
  const auto estimate = [&](double value, const std::function<double(std::size_t)>& value_without) {
    Eigen::ArrayXd values(without.size());
    for (std::size_t i = 0; i < without.size(); ++i) values[static_cast<Eigen::Index>(i)] = value_without(i);
    return Estimate{value, std::sqrt((values - values.mean()).square().sum() * (count - 1) / count)};
  };

  WaterColumnBias bias;
  bias.energy = estimate(all.energy / count, [&](std::size_t i) { return without[i].energy / (count - 1); });
  bias.spot = estimate(SpotOf(all), [&](std::size_t i) { return SpotOf(without[i]); });
  const double refracted = RefractedAngle(column.incidence, column.refractive_index);
  const EchoSetup setup = SetupOf(column, pulse_lengths, 1);
  for (const double length : pulse_lengths) {
    const DetectedBottom clear = ClearBottom(setup, length);
    const std::optional<DetectedBottom> bottom = DetectBottom(all, length);
    std::vector<DetectedBottom> others;
    for (const Echo& rest : without)
      if (const std::optional<DetectedBottom> other = DetectBottom(rest, length)) others.push_back(*other);
    if (!bottom || others.size() < without.size()) {
      bias.by_pulse.emplace_back();
      continue;
    }
    DetectedBias detected;
    for (const Detector detector : kDetectors) {
      const std::size_t d = Index(detector);
      // The error of the slanted path: positive is too deep.
      const auto deep = [&](const DetectedBottom& of) {
        return (of.by[d].time - clear.by[d].time) * std::cos(refracted);
      };
      // On a bottom of tilt s the reported depth is wrong by s times this: the part of the bottom that is measured lies
      // so far behind the reported point.
      const auto along = [&](const DetectedBottom& of) {
        return deep(of) * std::tan(refracted) - (of.by[d].by_tilt - clear.by[d].by_tilt) * std::cos(refracted);
      };
      detected.vertical[d] = estimate(-deep(*bottom), [&](std::size_t i) { return -deep(others[i]); });
      detected.along[d] = estimate(along(*bottom), [&](std::size_t i) { return along(others[i]); });
    }
    detected.stretch =
        estimate(bottom->width / clear.width, [&](std::size_t i) { return others[i].width / clear.width; });
    bias.by_pulse.emplace_back(detected);
  }
  return bias;
}

WaterColumnBias ComputeWaterColumn(const PhaseFunction& phase, const WaterColumn& column,
                                   std::span<const double> pulse_lengths, const WaterEffort& effort) {
  const std::array scattering = {column.scattering}, fields_of_view = {column.field_of_view};
  return std::move(ComputeWaterColumns(phase, column, scattering, fields_of_view, pulse_lengths, effort)[0][0]);
}

std::vector<std::vector<WaterColumnBias>> ComputeWaterColumns(const PhaseFunction& phase, const WaterColumn& column,
                                                              std::span<const double> scattering,
                                                              std::span<const double> fields_of_view,
                                                              std::span<const double> pulse_lengths,
                                                              const WaterEffort& effort) {
  const WalkSetup walk{.refracted = RefractedAngle(column.incidence, column.refractive_index),
                       .refractive_index = column.refractive_index,
                       .longest_excess = kAbsorbed / std::max(column.absorption, 1e-3)};
  std::vector<std::vector<Crossings>> pools(effort.pools);
  tbb::parallel_for(std::uint32_t{0}, effort.pools, [&](std::uint32_t pool) {
    pools[pool] = WalkPhotons(phase, walk, scattering, effort.photons, effort.seed, effort.cell, pool);
  });
  // Few of the pairs in a wide view are in a narrow one, so narrow views get their own pairs.
  const auto narrow = static_cast<std::size_t>(std::upper_bound(fields_of_view.begin(), fields_of_view.end(), kNarrow) -
                                               fields_of_view.begin());
  std::vector<std::vector<WaterColumnBias>> biases(scattering.size());
  for (std::size_t depth = 0; depth < scattering.size(); ++depth) {
    for (const auto& views : {fields_of_view.first(narrow), fields_of_view.subspan(narrow)}) {
      if (views.empty()) continue;
      WaterColumn seen = column;
      seen.field_of_view = views.back();
      const EchoSetup setup = SetupOf(seen, pulse_lengths, effort.pairs_per_photon);
      std::vector<std::vector<Echo>> echoes(views.size(), std::vector<Echo>(effort.pools));
      tbb::parallel_for(std::uint32_t{0}, effort.pools, [&](std::uint32_t pool) {
        const Crossings& crossings = pools[pool][depth];
        std::vector<Echo> paired = PairPhotons(crossings, crossings, setup, views, effort.seed, effort.cell, pool);
        for (std::size_t view = 0; view < views.size(); ++view) echoes[view][pool] = std::move(paired[view]);
      });
      for (std::size_t view = 0; view < views.size(); ++view) {
        seen.field_of_view = views[view];
        biases[depth].push_back(BiasOfEchoes(echoes[view], seen, pulse_lengths));
      }
    }
  }
  return biases;
}

}  // namespace albtpu
