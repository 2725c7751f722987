#include "validation/studies/response_comparison.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "sea/sampled_spectrum.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"
#include "validation/studies/closed_form_ratio.h"

namespace albtpu {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

HarmonicSpectrum SamplesOf(const WindSea& waves) {
  return Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
}

// Waves of a height [m] and period [s] that travel `towards` [degree] to the left of their wind.
HarmonicSpectrum Waves(double hs, double tp, double towards, double wind, double depth) {
  const JonswapWaves waves{.significant_wave_height = hs,
                           .peak_period = tp,
                           .travels_towards = RadiansOfDegrees(-towards)};  // of the compass, clockwise
  return Describe({.waves = std::make_shared<JonswapSpectrum>(std::vector{waves}, depth),
                   .wind_speed_10m = wind,
                   .wind_from = std::numbers::pi,
                   .water_depth = depth})
      .spectrum;
}

HarmonicSpectrum Jonswap() { return Waves(0.6, 3.2, 20, 6, kInf); }
HarmonicSpectrum Tma() { return Waves(0.5, 4, 40, 7, 5); }

// A wind sea of Elfouhaily's with a swell of 0.57 m and 25 m that travels `degrees` to the left of the wind.
HarmonicSpectrum CrossingSwell(double wind, double degrees) {
  constexpr double kPeak = 0.25, kWidth = 0.25, kVariance = 0.02, kSpreading = 12;
  HarmonicSpectrum swell = FlatSea(SeaWavenumbers(), kSeaHarmonics);
  for (std::size_t i = 0; i < swell.size(); ++i) {
    const double x = std::log(swell.k[i] / kPeak) / kWidth;
    swell.s[i] = kVariance * std::exp(-x * x / 2) / (swell.k[i] * kWidth * std::sqrt(2 * std::numbers::pi));
  }
  double mean = 1;  // of cos(n psi) under cos^2s(psi / 2)
  for (int n = 1; n <= 2 * static_cast<int>(kSeaHarmonics); ++n) {
    mean *= (kSpreading - n + 1) / (kSpreading + n);
    if (n % 2 == 0) std::fill(swell.a[n / 2 - 1].begin(), swell.a[n / 2 - 1].end(), mean);
  }
  return WeightedSum(SamplesOf({.wind_speed_10m = wind, .model = &kElfouhailyModel}), 1,
                     Rotated(std::move(swell), RadiansOfDegrees(degrees)), 1);
}

HarmonicSpectrum Isotropic() {
  const HarmonicSpectrum sea = SamplesOf({8, kInf, &kElfouhailyModel});
  HarmonicSpectrum even = FlatSea(sea.k, kSeaHarmonics);
  even.s = sea.s;
  return even;
}

// Without the waves much shorter than 2 pi / `highest` [rad/m].
HarmonicSpectrum Without(HarmonicSpectrum sea, double highest) {
  for (std::size_t i = 0; i < sea.size(); ++i) sea.s[i] *= std::exp(-std::pow(sea.k[i] / highest, 4));
  return sea;
}

HarmonicSpectrum WithoutCapillaries() { return Without(SamplesOf({9, kInf, &kElfouhailyModel}), 200); }

WindSea YoungSea() { return {.wind_speed_10m = 10, .fetch = 2e3, .model = &kElfouhailyModel}; }
WindSea NarrowSea() { return {.wind_speed_10m = 6, .spreading = 15}; }

}  // namespace

ResponseSea ResponseSeaOf(std::string name, const WindSea& waves) { return {std::move(name), waves, SamplesOf(waves)}; }

ResponseSea ResponseSeaOf(std::string name, const HarmonicSpectrum& spectrum) {
  const KnownWaves waves{std::make_shared<SampledSpectrum>(
      spectrum, SpectrumText{.name = name, .reference = "none", .departures = "none"})};
  return {std::move(name), waves, spectrum};
}

std::vector<ResponseSea> ResponseSeas() {
  return {ResponseSeaOf("Apel, 9 m/s", WindSea{9, kInf, &kApelModel}),
          ResponseSeaOf("Apel, 13 m/s, 20 km", WindSea{13, 2e4, &kApelModel}),
          ResponseSeaOf("Elfouhaily, 8 m/s", WindSea{8, kInf, &kElfouhailyModel}),
          ResponseSeaOf("Elfouhaily, 10 m/s, 2 km", YoungSea()),
          ResponseSeaOf("JONSWAP and tail", Jonswap()),
          ResponseSeaOf("swell at 30 degrees", CrossingSwell(5, 30)),
          ResponseSeaOf("swell at 60 degrees", CrossingSwell(7, 60)),
          ResponseSeaOf("swell at 120 degrees", CrossingSwell(9, 120)),
          ResponseSeaOf("TMA in 5 m", Tma()),
          ResponseSeaOf("isotropic", Isotropic()),
          ResponseSeaOf("narrow", NarrowSea()),
          ResponseSeaOf("without capillaries", WithoutCapillaries())};
}

std::vector<ResponseSea> ResolvedSeas() {
  const auto resolved = [](std::string name, const HarmonicSpectrum& spectrum) {
    return ResponseSeaOf(std::move(name), Without(spectrum, 30));
  };
  return {resolved("Apel, 15 m/s", SamplesOf({15, kInf, &kApelModel})),
          resolved("Apel, 15 m/s, 1.5 km", SamplesOf({15, 1.5e3, &kApelModel})),
          resolved("Elfouhaily, 10 m/s, 2 km", SamplesOf(YoungSea())),
          resolved("JONSWAP and tail", Jonswap()),
          resolved("swell at 60 degrees", CrossingSwell(7, 60)),
          resolved("narrow", SamplesOf(NarrowSea()))};
}

namespace {

// Beams that share footprint, profile and refractive index are traced on the same surfaces.
constexpr int kFootprints = 6, kBeamsOfFootprint = 10;

SeaCase RandomBeams(bool gaussian, std::mt19937_64& bits) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(bits() >> 11);
  };
  SeaCase sea_case;
  sea_case.refractive_index = between(1.33, 1.345);
  const double footprint = 0.2 * std::exp(between(0, std::log(30)));
  for (int b = 0; b < kBeamsOfFootprint; ++b) {
    sea_case.beams.push_back({.incidence = b == 0 ? 0 : RadiansOfDegrees(between(0, 30)),
                              .azimuth = RadiansOfDegrees(between(0, 360)),
                              .footprint = footprint,
                              .profile = gaussian ? BeamProfile::kGaussian : BeamProfile::kUniform});
  }
  return sea_case;
}

// Relative errors to which the theory is held, besides the standard errors of the tracing: in rms and for each beam.
struct Bound {
  ComparedQuantity quantity;
  double rms, each;
};
// Beams on the same surfaces have nearly the same random error of the bias along the beam: its rms is of few samples.
constexpr double kAny = std::numeric_limits<double>::infinity();

constexpr std::array<Bound, 7> kOnManySeas = {{{ComparedQuantity::kAlong, 0.0035, 0.02},
                                               {ComparedQuantity::kCross, 0.0035, 0.02},
                                               {ComparedQuantity::kThu, 0.003, 0.015},
                                               {ComparedQuantity::kTvu, 0.005, 0.025},
                                               {ComparedQuantity::kBiasAlongBeam, kAny, 0.01},
                                               {ComparedQuantity::kBiasVertical, 0.01, 0.01},
                                               {ComparedQuantity::kThuAtSurface, 0.03, 0.06}}};
// Tracing does not draw the waves shorter than its grid, but adds their mean effect to the rays. Without such waves it
// is exact.
constexpr std::array<Bound, 7> kOnResolvedSeas = {{{ComparedQuantity::kAlong, 0.001, 0.003},
                                                   {ComparedQuantity::kCross, 0.001, 0.003},
                                                   {ComparedQuantity::kThu, 0.001, 0.003},
                                                   {ComparedQuantity::kTvu, 0.003, 0.003},
                                                   {ComparedQuantity::kBiasAlongBeam, kAny, 0.005},
                                                   {ComparedQuantity::kBiasVertical, kAny, 0.005},
                                                   {ComparedQuantity::kThuAtSurface, 0.01, 0.02}}};
// A footprint that passes less than this fraction of the mean square slope is far longer than the waves. There THU by
// the theory is up to half a per cent less.
constexpr double kFarLonger = 0.01;
constexpr Bound kUnderFarLongerBeams = {ComparedQuantity::kThu, kAny, 0.015};

Comparison Judge(const std::vector<ComparedBeam>& beams, const Bound& bound, const char* seas) {
  const double k = StandardErrorsFor(static_cast<int>(kComparedQuantities.size() * beams.size()));
  const Agreement found = AgreementOf(beams, bound.quantity, k);
  Comparison judged{
      .quantity = absl::StrFormat("theory over tracing, %s, rms departure from 1, %s", Name(bound.quantity), seas),
      .unit = "%",
      .published = 0,
      .ours = 100 * found.rms,
      .standard_error = 100 * found.standard_error,
      .basis = "no verdict: under no beam is it large enough to matter"};
  if (found.beams == 0) return judged;
  const bool agrees = found.worst_beyond <= bound.each && found.rms <= std::hypot(bound.rms, found.standard_error);
  judged.verdict = AgreesIf(agrees);
  const std::string of_all =
      std::isinf(bound.rms) ? "" : absl::StrFormat("%.2f %% rms besides standard errors, ", 100 * bound.rms);
  judged.basis = absl::StrFormat("within %s%.2f %% and %.1f standard errors for each of %d beams; at worst %.2f %%",
                                 of_all, 100 * bound.each, k, found.beams, 100 * found.worst);
  return judged;
}

}  // namespace

std::vector<ComparedBeam> CompareBeams(const ResponseSea& sea, SeaCase sea_case, const TracingEffort& effort,
                                       std::uint64_t seed, std::uint32_t cell) {
  sea_case.sea.waves = sea.waves;
  sea_case.depths = {0, kComparedDepth};
  const SeaState state(sea_case.sea);
  Discretization grid = ChooseDiscretization(state, sea_case.beams);
  grid.points_per_footprint *= effort.finer;
  grid.rays = std::min(effort.finer * effort.finer * grid.rays, kMaxRays);
  sea_case.discretization = grid;
  const SeaCaseResult traced =
      Simulate(sea_case, {.realizations = effort.realizations, .most_realizations = effort.realizations}, seed, cell);
  const SeaResponse theory(sea.spectrum, sea_case.refractive_index);
  const double all_slopes = SlopeCovariance(state).trace();
  std::vector<ComparedBeam> compared;
  for (std::size_t b = 0; b < sea_case.beams.size(); ++b) {
    const BeamOptions& beam = sea_case.beams[b];
    const auto power = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
    compared.push_back({sea.name, beam, sea_case.refractive_index, SlopeCovariance(state, power).trace() / all_slopes,
                        theory(beam), traced.beams[b]});
  }
  return compared;
}

std::vector<ComparedBeam> CompareRandomBeams(const std::vector<ResponseSea>& seas, bool few,
                                             const TracingEffort& effort, std::uint64_t seed) {
  std::vector<ComparedBeam> all;
  std::mt19937_64 bits(seed);
  for (int i = 0; i < static_cast<int>(seas.size()); ++i) {
    for (int f = 0; f < kFootprints; ++f) {
      SeaCase sea_case = RandomBeams(f % 3 == 1, bits);
      if (few) {
        if (f != i % kFootprints) continue;
        sea_case.beams.resize(kBeamsOfFootprint / 2);
      }
      const auto cell = static_cast<std::uint32_t>(i * kFootprints + f);
      std::vector<ComparedBeam> beams = CompareBeams(seas[i], std::move(sea_case), effort, seed, cell);
      std::move(beams.begin(), beams.end(), std::back_inserter(all));
    }
  }
  return all;
}

namespace {

// What theory and tracing say of a quantity, and how small the tracing may be.
struct TwoSides {
  const char* name;
  double (*theory)(const BeamResponse&);
  Estimate (*traced)(const BeamUncertainty&);
  double least;
};

using Ours = const BeamResponse&;
using Traced = const BeamUncertainty&;
constexpr double kMinAngle = RadiansOfDegrees(0.2), kMinLength = 0.0005 * kComparedDepth, kAt = kComparedDepth;

// In the order of ComparedQuantity.
constexpr std::array<TwoSides, 7> kSides = {{
    {"along", [](Ours b) { return b.refraction_along_wind(); }, [](Traced b) { return b.refraction_along_wind; },
     kMinAngle},
    {"cross", [](Ours b) { return b.refraction_cross_wind(); }, [](Traced b) { return b.refraction_cross_wind; },
     kMinAngle},
    {"thu", [](Ours b) { return b.Thu(kAt); }, [](Traced b) { return b.thu[1]; }, 0},
    {"tvu", [](Ours b) { return b.Tvu(kAt); }, [](Traced b) { return b.tvu[1]; }, kMinLength},
    {"bias along", [](Ours b) { return b.BiasAlongBeam(kAt); }, [](Traced b) { return b.bias_along_beam[1]; },
     kMinLength},
    {"bias vertical", [](Ours b) { return b.BiasVertical(kAt); }, [](Traced b) { return b.bias_vertical[1]; }, 0},
    {"thu at depth 0", [](Ours b) { return b.Thu(0); }, [](Traced b) { return b.thu[0]; }, 0.0005},
}};

}  // namespace

const char* Name(ComparedQuantity quantity) { return kSides[static_cast<std::size_t>(quantity)].name; }

Estimate RatioOf(const ComparedBeam& beam, ComparedQuantity quantity) {
  const TwoSides& sides = kSides[static_cast<std::size_t>(quantity)];
  const Estimate traced = sides.traced(beam.traced);
  if (std::abs(traced.value) < sides.least) return {kNoNumber, kNoNumber};
  return {sides.theory(beam.theory) / traced.value, traced.standard_error / std::abs(traced.value)};
}

Agreement AgreementOf(const std::vector<ComparedBeam>& beams, ComparedQuantity quantity, double standard_errors) {
  Agreement agreement;
  double squares = 0, variances = 0;
  for (const ComparedBeam& beam : beams) {
    const Estimate ratio = RatioOf(beam, quantity);
    if (std::isnan(ratio.value)) continue;
    const double error = std::abs(ratio.value - 1);
    ++agreement.beams;
    squares += error * error;
    variances += ratio.standard_error * ratio.standard_error;
    agreement.worst = std::max(agreement.worst, error);
    agreement.worst_beyond = std::max(agreement.worst_beyond, error - standard_errors * ratio.standard_error);
  }
  if (agreement.beams == 0) return agreement;
  agreement.rms = std::sqrt(squares / agreement.beams);
  agreement.standard_error = std::sqrt(variances / agreement.beams);
  return agreement;
}

std::vector<Comparison> VerdictsOnManySeas(const std::vector<ComparedBeam>& beams) {
  std::vector<Comparison> verdicts;
  for (const Bound& bound : kOnManySeas) verdicts.push_back(Judge(beams, bound, "many seas"));
  return verdicts;
}

std::vector<Comparison> VerdictsOnResolvedSeas(const std::vector<ComparedBeam>& beams) {
  std::vector<ComparedBeam> shorter, longer;
  for (const ComparedBeam& beam : beams) (beam.seen < kFarLonger ? longer : shorter).push_back(beam);
  std::vector<Comparison> verdicts;
  for (const Bound& bound : kOnResolvedSeas) verdicts.push_back(Judge(shorter, bound, "seas that a grid holds"));
  verdicts.push_back(Judge(longer, kUnderFarLongerBeams, "footprints far longer than the waves"));
  return verdicts;
}

}  // namespace albtpu
