// The seas on which the response theory is compared with tracing.
#pragma once

#include <string>
#include <vector>

#include "sea/spectra/harmonic_spectrum.h"
#include "sea/wave_state.h"

namespace albtpu {

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

}  // namespace albtpu
