// The effect of the water column on the reported bottom, by Monte Carlo.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/water/bottom_detector.h"
#include "generator/water/photon_walk.h"

namespace albtpu {

// The shape of a pulse in water: everything that the relative bias depends on. Lengths are over the depth z.
struct WaterColumn {
  double incidence = 0;                      // in air [radian, below 1]
  double refractive_index = kSeaWaterIndex;  // of phase
  double group_index = 1.36;
  double scattering = 0;            // b z, above 0
  double absorption = 0;            // a / b
  double field_of_view = INFINITY;  // diameter of the disc on the surface that the receiver sees, across the beam
  double footprint = 0;             // 1/e^2 diameter of the Gaussian beam, across it
};

// For one pulse length. Lengths are over the depth; reported minus true.
struct DetectedBias {
  std::array<Estimate, 3> vertical;  // by Detector; positive: reported too shallow
  std::array<Estimate, 3> along;     // positive: reported too far along the beam
  Estimate stretch;                  // width of the echo at half its maximum over that in clear water
};

struct WaterColumnBias {
  std::vector<std::optional<DetectedBias>> by_pulse;  // nullopt where the echo has no clear end
  Estimate spot;    // standard deviation, along the beam, of where on the bottom the echo comes from
  Estimate energy;  // of the echo within the field of view over that of unscattered light
};

struct WaterEffort {
  std::uint32_t photons = 200'000;  // of each pool
  std::uint32_t pools = 8;          // Standard errors are of the scatter of pools: photons of one are paired often.
  int pairs_per_photon = 5;
  std::uint64_t seed = 1;
  std::uint32_t cell = 0;
};

// `pulse_lengths` are full widths at half maximum as c t / (2 n_group z), above 0. Pools are computed in parallel; the
// result is the same on any number of threads.
WaterColumnBias ComputeWaterColumn(const PhaseFunction& phase, const WaterColumn& column,
                                   std::span<const double> pulse_lengths, const WaterEffort& effort);

// The estimate from echoes of several pools of the same column.
WaterColumnBias BiasOfEchoes(std::span<const Echo> pools, const WaterColumn& column,
                             std::span<const double> pulse_lengths);

// The same for several depths of one water and several fields of view: one walk serves all. `scattering` increases and
// takes the place of `column.scattering`; `fields_of_view` increase and take the place of its field of view. Element
// [i][j] is of scattering[i] and fields_of_view[j].
std::vector<std::vector<WaterColumnBias>> ComputeWaterColumns(const PhaseFunction& phase, const WaterColumn& column,
                                                              std::span<const double> scattering,
                                                              std::span<const double> fields_of_view,
                                                              std::span<const double> pulse_lengths,
                                                              const WaterEffort& effort);

// The angle in the water of a beam [radian].
double RefractedAngle(double incidence, double refractive_index);

}  // namespace albtpu
