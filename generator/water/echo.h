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

// A bottom that falls ahead by the tilt s has the depth 1 + s x. To first order in s, a photon goes on straight to it:
// that it may scatter on the added way h moves it by a distance of order h with a probability of order h. With the
// ways u along and across the beam for each length down and w = sqrt(1 + u^2), photon i meets the bottom s x w_i later
// and s x u_i farther ahead; photon j from the receiver likewise, which must therefore leave the surface at
//     e = x - x_j + s x (u_i - u_j).
// The time of the pair grows by s x [(w_i + w_j) / 2 + sin(incidence) (u_i - u_j) / (2 n_group)]. Absorption takes the
// fraction s x a (w_i + w_j) of it, the light from the receiver thins out on the bottom as 1 - s u_j, and pairs enter
// or leave the field of view.

struct EchoSetup {
  double incidence = 0;             // in air [radian]
  double refracted = 0;             // the angle in the water [radian]
  double group_index = 1.36;        // above 1
  double absorption = 0;            // over scattering
  double footprint = 0;             // 1/e^2 diameter of the Gaussian beam, across it, over z
  double field_of_view = INFINITY;  // diameter of the receiver's disc on the surface, across the beam, over z
  double tilt = 0;                  // of the bottom, to first order for each photon
  double step = 0;                  // of the times
  int pairs_per_photon = 1;
};

// How a pair changes for each unit of the bottom's tilt: by what time it is later, and which fraction of it is lost.
struct TiltOfPair {
  double delay = 0, loss = 0;
};

// Weights of pairs over their time, and sums over all pairs. Weights are relative to unscattered light: without
// scattering their sum is 1.
struct Echo {
  static constexpr double kEarliest = -2, kLatest = 5;  // Pairs outside count in the sums alone.

  double step;
  std::vector<double> weights;         // at kEarliest + i * step; a pair is split between its two neighbours
  std::vector<double> delays, losses;  // the weights times those of TiltOfPair
  double energy = 0;                   // of all pairs
  // Times the point on the bottom, ahead of where unscattered light meets it, and its square.
  double ahead = 0, ahead_squared = 0;

  explicit Echo(double of_step = 1);

  void Add(double time, double ahead_of, double weight, const TiltOfPair& tilt);  // a pair
  // A fraction of light that is lost to a tilt alone, as at the edge of a field of view.
  void AddLoss(double time, double weight);
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
