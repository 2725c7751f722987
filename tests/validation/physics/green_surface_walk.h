// The slow twin of the green surface's echo (budget/water/green_surface.h): photons of a laser that water scatters back
// through its surface, each on a walk of its own, and the detector on the waveform that they make. No formula of the
// echo is used.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "budget/water/water_receiver.h"
#include "generator/water/photon_walk.h"

namespace albtpu {

// In metres, 1/m and ns.
struct GreenSurfaceWalk {
  double incidence = 0;  // in air [radian]
  double refractive_index = 1.34, group_index = 1.3643;
  double scattering = 0, absorption = 0;
  std::vector<double> fields_of_view = {5};    // diameters of discs on the surface that receivers see, across the beam
  double cone = 8 * M_PI / 180;                // half angle, in the water, in which the receiver accepts light [radian]
  double longest = 5;                          // ns after the glint, beyond which light is not followed
  std::uint32_t photons = 20'000, pools = 16;  // of each pool
};

// Light by the time after the glint, in steps of kStep: for the water that a beam enters undimmed it would be 1 in all.
struct WalkedEcho {
  static constexpr double kStep = 0.02;   // ns
  std::vector<std::vector<double>> seen;  // by field of view
  std::vector<double> once;               // what was scattered once
};

// One for each pool.
std::vector<WalkedEcho> WalkGreenSurface(const PhaseFunction& phase, const GreenSurfaceWalk& walk, std::uint64_t seed);

// m, of the range in air: where the detector finds the surface behind the glint alone, which is as in
// GreenSurfaceDelay(). `light` is that of the water in steps of WalkedEcho::kStep.
double DelayOfWaveform(const std::vector<double>& light, double glint, const WaterReceiver& receiver);

// That of the mean of some pools, with its standard error by jackknife.
struct WalkedDelay {
  double delay = 0, standard_error = 0;
};
WalkedDelay DelayOf(const std::vector<WalkedEcho>& pools,
                    const std::function<const std::vector<double>&(const WalkedEcho&)>& light, double glint,
                    const WaterReceiver& receiver);

}  // namespace albtpu
