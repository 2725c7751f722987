// The echo of the bottom from pairs of photons: its times at the receiver, and its origin on the bottom.
//
// The light from a Lambertian bottom does not depend on the direction of incidence, and paths of light are reversible.
// So the echo is the sum over pairs of a photon on its way down and a photon traced backwards from the receiver that
// meet at the same point of the bottom. Times are in units of 2 n_group z / c: of the way of light to the depth z and
// back. All lengths here are in units of z.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "generator/water/photon_walk.h"

namespace albtpu {

struct EchoSetup {
  double incidence = 0;             // in air [radian]
  double group_index = 1.36;        // above 1
  double absorption = 0;            // over scattering
  double footprint = 0;             // 1/e^2 diameter of the Gaussian beam, across it, over z
  double field_of_view = INFINITY;  // diameter of the receiver's disc on the surface, across the beam, over z
  double step = 0;                  // of the times
  int pairs_per_photon = 1;
};

// Weights of pairs over their time, and sums over all pairs. Weights are relative to unscattered light: without
// scattering their sum is 1.
struct Echo {
  static constexpr double kEarliest = -2, kLatest = 5;  // Pairs outside count in the sums alone.

  double step;
  std::vector<double> weights;        // at kEarliest + i * step; a pair is split between its two neighbours
  std::vector<double> ahead_weights;  // times the point on the bottom, ahead of where unscattered light meets it
  double energy = 0;                  // of all pairs
  double ahead = 0, ahead_squared = 0;

  explicit Echo(double of_step = 1);

  void Add(double time, double ahead_of, double weight);  // a pair
  double TimeAt(double i) const { return kEarliest + i * step; }
  Echo& operator+=(const Echo& other);  // of the same step
  Echo& operator*=(double factor);
};

// Two walks to the same depth, which may be the same walk: of the photons of the beam, and of photons traced backwards
// from the receiver. Streams are of (seed, cell, photon, pool).
Echo PairPhotons(const Crossings& sources, const Crossings& receivers, const EchoSetup& setup, std::uint64_t seed,
                 std::uint32_t cell, std::uint32_t pool);

// The same pairs seen in several fields of view, increasing, the last of which is that of `setup`: an echo for each.
std::vector<Echo> PairPhotons(const Crossings& sources, const Crossings& receivers, const EchoSetup& setup,
                              std::span<const double> fields_of_view, std::uint64_t seed, std::uint32_t cell,
                              std::uint32_t pool);

}  // namespace albtpu
