// The standard errors stated by the Monte Carlo against the scatter of its estimates, and its estimates against those
// of tracing alone.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "generator/monte_carlo/beam_tracing.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "tests/degree.h"
#include "tests/every_case.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;
const int kRepetitions = albtpu::testing::EveryCase() ? 200 : 100;
constexpr int kRealizations = 64;  // of each repetition
constexpr int kPlain = 6000;       // by tracing alone
constexpr std::size_t kNadir = 0, kSlanted = 1;
constexpr std::size_t kNoDepth = 0, kShallow = 1, kDeep = 2;

struct RepeatedQuantity {
  const char* name;
  std::size_t beam;
  std::function<Estimate(const BeamUncertainty&)> of;
  double gain = 0;  // The least factor by which control variates divide the standard error; 0: not stated.
};

const std::vector<RepeatedQuantity> kRepeatedQuantities = {
    {"refraction along wind, nadir", kNadir, [](const auto& beam) { return beam.refraction_along_wind; }, 10},
    {"THU, nadir", kNadir, [](const auto& beam) { return beam.thu[kDeep]; }, 10},
    {"THU, nadir, depth 0", kNadir, [](const auto& beam) { return beam.thu[kNoDepth]; }},
    {"TVU, nadir", kNadir, [](const auto& beam) { return beam.tvu[kDeep]; }, 4},
    {"vertical bias, nadir", kNadir, [](const auto& beam) { return beam.bias_vertical[kDeep]; }},
    {"refraction along wind, 20 degrees", kSlanted, [](const auto& beam) { return beam.refraction_along_wind; }, 10},
    {"refraction cross wind, 20 degrees", kSlanted, [](const auto& beam) { return beam.refraction_cross_wind; }},
    {"THU, 20 degrees", kSlanted, [](const auto& beam) { return beam.thu[kDeep]; }, 10},
    {"THU, 20 degrees, depth 0", kSlanted, [](const auto& beam) { return beam.thu[kNoDepth]; }},
    {"THU, 20 degrees, 0.1 m", kSlanted, [](const auto& beam) { return beam.thu[kShallow]; }},
    {"TVU, 20 degrees", kSlanted, [](const auto& beam) { return beam.tvu[kDeep]; }, 4},
    {"TVU, 20 degrees, depth 0", kSlanted, [](const auto& beam) { return beam.tvu[kNoDepth]; }},
    {"TVU, 20 degrees, 0.1 m", kSlanted, [](const auto& beam) { return beam.tvu[kShallow]; }},
    {"bias along the beam, 20 degrees", kSlanted, [](const auto& beam) { return beam.bias_along_beam[kDeep]; }},
    {"vertical bias, 20 degrees", kSlanted, [](const auto& beam) { return beam.bias_vertical[kDeep]; }},
};

constexpr double kIndex = 1.33;
const std::vector<BeamOptions> kRepeatedBeams = {
    {.footprint = 0.5}, {.incidence = 20 * kDegree, .azimuth = 30 * kDegree, .footprint = 0.5}};

// What `Simulate` does, but what all its realizations share, which takes longer than hundreds of them, is made once.
class RepeatedSimulation {
 public:
  explicit RepeatedSimulation(Estimator estimator, const WindSea& waves = {.wind_speed_10m = 5},
                              const std::vector<BeamOptions>& beams = kRepeatedBeams)
      : beams_(beams), sea_({.waves = waves}), model_(sea_, beams.back(), ChooseDiscretization(sea_, beams)) {
    const TracedBeams traced{.beams = beams_,
                             .refractive_index = kIndex,
                             .rays = 1000,  // a quarter of the usual number: the same error of both estimators
                             .unresolved_slopes = Eigen::Matrix2d::Zero(),
                             .resolved_slopes = model_.FacetSlopeCovariance([](double, double) { return 1.0; })};
    tracing_ =
        estimator == Estimator::kPlain ? MakePlainTracing(model_, traced) : MakeAntitheticTracing(model_, traced);
  }

  std::vector<BeamUncertainty> Of(int realizations, std::uint32_t cell) const {
    std::vector<std::vector<BeamRealization>> realized(realizations, std::vector<BeamRealization>(beams_.size()));
    const std::vector<bool> all(beams_.size(), true);
    tbb::parallel_for(0, realizations, [&](int i) { tracing_->Realize(NormalStream(5, cell, i), all, realized[i]); });
    std::vector<BeamUncertainty> beams;
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      std::vector<BeamRealization> sample;
      for (const std::vector<BeamRealization>& each : realized) sample.push_back(each[b]);
      beams.push_back(UncertaintyOf(sample, beams_[b], kIndex, tracing_->known_slopes(b), {0, 0.1, 10}));
    }
    return beams;
  }

 private:
  std::vector<BeamOptions> beams_;
  SeaState sea_;
  SurfaceModel model_;
  std::unique_ptr<BeamTracing> tracing_;
};

TEST(StandardErrors, MatchTheScatterOfTheEstimatesAboutTracingAlone) {
  const RepeatedSimulation with_controls(Estimator::kControlVariate);
  std::vector<std::vector<BeamUncertainty>> repetitions;
  for (int i = 0; i < kRepetitions; ++i) repetitions.push_back(with_controls.Of(kRealizations, 1 + i));
  const std::vector<BeamUncertainty> plain = RepeatedSimulation(Estimator::kPlain).Of(kPlain, 0);
  for (const RepeatedQuantity& quantity : kRepeatedQuantities) {
    Eigen::ArrayXd values(kRepetitions);
    double claimed = 0;  // the root of the mean square
    for (int i = 0; i < kRepetitions; ++i) {
      const Estimate estimate = quantity.of(repetitions[i][quantity.beam]);
      values[i] = estimate.value;
      claimed += estimate.standard_error * estimate.standard_error / kRepetitions;
    }
    claimed = std::sqrt(claimed);
    const Estimate mean = Mean(values), twin = quantity.of(plain[quantity.beam]);
    EXPECT_NEAR(mean.value, twin.value, 3.5 * std::hypot(mean.standard_error, twin.standard_error)) << quantity.name;
    // The scatter of n values is known to 1 / sqrt(2 n), a little worse for means of heavy-tailed products.
    EXPECT_NEAR(0.5 * TwoSigma(values).value / claimed, 1, 3 * 1.2 / std::sqrt(2 * kRepetitions)) << quantity.name;
    EXPECT_LT(quantity.gain * claimed * std::sqrt(kRealizations), twin.standard_error * std::sqrt(kPlain))
        << quantity.name;
  }
}

// Nodes of survey.h5 of the largest biases along the beam, of which the tables have another error than these by chance
// alone. The footprint is narrow, so that its grid holds all waves.
TEST(StandardErrors, OfBiasesAlongTheBeamMatchTheirScatterAboutTheTheory) {
  const WindSea waves{.wind_speed_10m = 15, .fetch = 1000, .model = &kElfouhailyModel};
  const std::vector<BeamOptions> beams = {{.incidence = 20 * kDegree, .footprint = 0.1},
                                          {.incidence = 25 * kDegree, .footprint = 0.1}};
  const RepeatedSimulation traced(Estimator::kControlVariate, waves, beams);
  const SeaResponse theory(Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), 1), kIndex);
  std::vector<std::vector<BeamUncertainty>> repetitions;
  for (int i = 0; i < kRepetitions; ++i) repetitions.push_back(traced.Of(kRealizations, 1 + i));
  for (std::size_t b = 0; b < beams.size(); ++b) {
    Eigen::ArrayXd values(kRepetitions), claimed(kRepetitions);
    for (int i = 0; i < kRepetitions; ++i) {
      const Estimate bias = repetitions[i][b].bias_along_beam[kDeep];
      values[i] = bias.value;
      claimed[i] = bias.standard_error;
    }
    const Estimate mean = Mean(values);
    const double expected = theory(beams[b]).BiasAlongBeam(10), scatter = 0.5 * TwoSigma(values).value;
    std::printf("traced %.5f +- %.5f m, by theory %.5f m; scatter over stated %.3f\n", mean.value, mean.standard_error,
                expected, scatter / std::sqrt(claimed.square().mean()));
    EXPECT_NEAR(mean.value, expected, 3.5 * mean.standard_error + 0.009 * std::abs(expected));
    EXPECT_NEAR(scatter / std::sqrt(claimed.square().mean()), 1, 3 * 0.06);
  }
}

}  // namespace
}  // namespace albtpu
