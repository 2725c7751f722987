// The response theory beside ray tracing, beam by beam, on seas of all kinds.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "generator/monte_carlo/monte_carlo.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "validation/report/study.h"

namespace albtpu {

// The seas on which the response theory is compared with tracing.

struct ResponseSea {
  std::string name;
  WaveState waves;            // as tracing draws them
  HarmonicSpectrum spectrum;  // as the theory takes them
};

ResponseSea ResponseSeaOf(std::string name, const WindSea& waves);
ResponseSea ResponseSeaOf(std::string name, const HarmonicSpectrum& spectrum);

// Wind seas and described ones: young and old, with swell across the wind, in shallow water, isotropic, narrow and
// without capillaries.
std::vector<ResponseSea> ResponseSeas();

// Some of them without waves much shorter than 0.2 m, so that a grid can hold all waves.
std::vector<ResponseSea> ResolvedSeas();

// One beam by the theory and by tracing, at the depths 0 and kComparedDepth.
struct ComparedBeam {
  std::string sea;
  BeamOptions beam;
  double refractive_index;
  double seen;  // the fraction of the mean square slope that the footprint passes
  BeamResponse theory;
  BeamUncertainty traced;
};
inline constexpr double kComparedDepth = 20;  // m

struct TracingEffort {
  int realizations = 300;
  int finer = 1;  // the factor on the default numbers of points and rays along the footprint
};

// Traces the beams of `sea_case` on `sea`. `cell` chooses the random numbers.
std::vector<ComparedBeam> CompareBeams(const ResponseSea& sea, SeaCase sea_case, const TracingEffort& effort,
                                       std::uint64_t seed, std::uint32_t cell);

// Random beams on each sea: 60 of six footprints from 0.2 to 6 m, two of them gaussian, or if `few` 5 of one footprint.
// Incidences are 0 to 30 degrees, refractive indices 1.33 to 1.345.
std::vector<ComparedBeam> CompareRandomBeams(const std::vector<ResponseSea>& seas, bool few,
                                             const TracingEffort& effort, std::uint64_t seed);

// The compared quantities of a beam, with lower limits: refraction from 0.2 degrees on, TVU and the bias along the beam
// from 0.5 mm per metre of depth, THU at the surface from 0.5 mm.
enum class ComparedQuantity { kAlong, kCross, kThu, kTvu, kBiasAlongBeam, kBiasVertical, kThuAtSurface };
inline constexpr std::array kComparedQuantities = {ComparedQuantity::kAlong,         ComparedQuantity::kCross,
                                                   ComparedQuantity::kThu,           ComparedQuantity::kTvu,
                                                   ComparedQuantity::kBiasAlongBeam, ComparedQuantity::kBiasVertical,
                                                   ComparedQuantity::kThuAtSurface};
const char* Name(ComparedQuantity quantity);  // "along", "cross", "thu", ...

// The theory over the tracing, with the standard error of the tracing; NaN where the quantity is too small.
Estimate RatioOf(const ComparedBeam& beam, ComparedQuantity quantity);

// Relative errors of all beams.
struct Agreement {
  int beams = 0;  // that count
  double rms = 0, worst = 0;
  double standard_error = 0;  // rms of those of the tracing
  double worst_beyond = 0;    // the largest error less `allowed` standard errors
};
Agreement AgreementOf(const std::vector<ComparedBeam>& beams, ComparedQuantity quantity, double standard_errors);

// Whether the theory is within its bounds of the tracing, for each quantity; and its closer bounds on seas of which a
// grid holds all waves.
std::vector<Comparison> VerdictsOnManySeas(const std::vector<ComparedBeam>& beams);
std::vector<Comparison> VerdictsOnResolvedSeas(const std::vector<ComparedBeam>& beams);

}  // namespace albtpu
