// The seas on which the response theory is compared with tracing.
#pragma once

#include <vector>

#include "sea/spectra/harmonic_spectrum.h"
#include "sea/wave_state.h"

namespace albtpu {

struct NamedSea {
  const char* name;
  WindSea waves;  // of any model
};

// Wind seas and described ones, young and old, with swell, in shallow water, isotropic, narrow and without capillaries;
// and a measured one if `buoy`, a file of NDBC spectra, is there.
std::vector<NamedSea> ResponseSeas(bool buoy);
bool HasBuoy();

// Some of them without waves much shorter than 0.2 m, all of which a grid can hold.
std::vector<NamedSea> ResolvedSeas();

// The spectrum as the response theory takes it.
HarmonicSpectrum SpectrumOf(const NamedSea& sea);

}  // namespace albtpu
