// A sea from its resolved waves, its wind and its depth.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "sea/spectra/frequency_spectrum.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/spectra/spectral_tail.h"

namespace albtpu {

// The given properties. Directions are of the compass, in rad.
struct SeaDescription {
  // Null: none are known, and the wind's spectrum, fully developed, is the whole sea.
  std::shared_ptr<const FrequencySpectrum> waves = {};
  // Absent: from the waves, by EquilibriumFrictionVelocity(). 0 is a calm: there are no waves but `waves`.
  std::optional<double> wind_speed_10m = {};  // m/s, from 0
  std::optional<double> wind_from = {};       // absent: along the shortest resolved waves, if they have a direction
  std::optional<double> water_depth = {};     // m, above 0; absent or infinity: deep water
  TailRule tail = TailRule::kRelax;
  std::optional<double> tail_from = {};  // Hz, above 0; absent: the waves' own trusted_up_to()
};

// The assumptions that were made where the description is silent.
struct SeaAssumptions {
  bool wind_speed_from_waves = false;
  bool wind_unknown = false;  // the waves do not reach the frequencies from which the wind is derived: taken as calm
  bool wind_direction_from_waves = false;
  bool wind_direction_unknown = false;  // the waves are isotropic, and so are those of the wind
  bool tail_from_of_waves = false;
  bool level_held = false;  // q lay outside 0.5 to 2
  bool wind_sea_missing = false;  // the waves are swell alone, below half of the wind's at the cut-off
  bool level_unknown = false;  // no energy to compare at the cut-off: q is 1
  bool axes_from_north = false;  // of harmonics of the whole sea, which count from the wind's direction, if it is given
};

struct DescribedSea {
  HarmonicSpectrum spectrum;  // at SeaWavenumbers(), in its frame
  HarmonicSpectrum resolved;  // its part that comes from `waves`
  double x_azimuth = 0;       // the compass direction [rad, from 0 to 2 pi] of the frame's x axis
  double wind_speed_10m = 0;  // m/s
  double water_depth = std::numeric_limits<double>::infinity();  // m
  double tail_from = 0;                                          // Hz; 0 if there are no resolved waves
  double cutoff = 0;                                             // rad/m, the wavenumber of tail_from
  double q = 1;
  SeaAssumptions assumed;
};

DescribedSea Describe(const SeaDescription& description);

// The same direction as `azimuth` [rad], from 0 to 2 pi.
double FullTurn(double azimuth);

}  // namespace albtpu
