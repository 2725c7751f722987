// The slow twin of the water column's Monte Carlo: every photon goes down, off the bottom and up again, and counts if
// it leaves the water within the field of view and the cone of the receiver. No reciprocity, no pairs, no scaling, and
// independent code.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "generator/water/echo.h"
#include "generator/water/photon_walk.h"

namespace albtpu {

// A photon on its way through homogeneous water, from scattering to scattering: the slow twin of PhotonWalk.

// In metres and 1/m. The bottom is depth + slope * (x - x0), where x0 is met without scattering.
struct RoundTrip {
  double incidence = 0;  // in air [radian]
  double refractive_index = 1.34, group_index = 1.36;
  double scattering = 0.28, absorption = 0.07;
  double depth = 10, slope = 0;
  double field_of_view = 16, footprint = 0;
  double cone = 10 * M_PI / 180;  // half angle, in the water, in which the receiver accepts light [radian]
};

inline double Uniform(std::mt19937_64& random) { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; }

// `about` turned by the angle whose half has the sine `sin_half`, to a random side.
inline Eigen::Vector3d Turned(const Eigen::Vector3d& about, double sin_half, std::mt19937_64& random) {
  const Eigen::Vector3d side = about.unitOrthogonal(), other = about.cross(side);
  const double cosine = 1 - 2 * sin_half * sin_half, sine = std::sqrt(1 - cosine * cosine);
  const double turn = 2 * std::numbers::pi * Uniform(random);
  return (cosine * about + sine * (std::cos(turn) * side + std::sin(turn) * other)).normalized();
}

// z is down.
class Traveller {
 public:
  Traveller(const PhaseFunction& phase, const RoundTrip& trip, double x0)
      : phase_(phase), trip_(trip), normal_(Eigen::Vector3d(trip.slope, 0, -1).normalized()), x0_(x0) {
    critical_ = std::sqrt(1 - 1 / (trip.refractive_index * trip.refractive_index));
  }

  Eigen::Vector3d at = Eigen::Vector3d::Zero(), going = Eigen::Vector3d::UnitZ();
  double path = 0;

  enum class End { kBottom, kSurface, kLost };

  // Travels until it meets the bottom, or the surface under an angle at which it leaves the water.
  End Travel(std::mt19937_64& random) {
    const double longest = 14 / trip_.absorption + 2 * trip_.depth;
    while (path < longest) {
      double free = -std::log(Uniform(random)) / trip_.scattering;
      while (true) {
        // The bottom: z = depth + slope (x - x0).
        const double above = trip_.depth + trip_.slope * (at.x() - x0_) - at.z();
        const double sinking = going.z() - trip_.slope * going.x();
        if (sinking > 0 && above <= free * sinking) {
          Go(above / sinking);
          return End::kBottom;
        }
        if (going.z() >= 0 || at.z() + free * going.z() > 0) break;
        const double way = -at.z() / going.z();
        Go(way);
        at.z() = 0;
        if (-going.z() > critical_) return End::kSurface;
        free -= way;
        going.z() = -going.z();
      }
      Go(free);
      going = Turned(going, phase_.SinHalf(Uniform(random)), random);
    }
    return End::kLost;
  }

  // Leaves the bottom in a direction of Lambertian reflection.
  void Reflect(std::mt19937_64& random) {
    going = Turned(normal_, std::sqrt((1 - std::sqrt(Uniform(random))) / 2), random);
  }

 private:
  void Go(double way) {
    at += way * going;
    path += way;
  }

  const PhaseFunction& phase_;
  const RoundTrip& trip_;
  Eigen::Vector3d normal_;
  double x0_, critical_;
};

// Echoes as PairPhotons gives them, one for each pool of `photons` photons; their energy is relative to the light that
// an unscattered beam sends into the cone.
std::vector<Echo> TraceRoundTrips(const PhaseFunction& phase, const RoundTrip& trip, double step, std::uint32_t pools,
                                  std::uint32_t photons, std::uint64_t seed);

}  // namespace albtpu
