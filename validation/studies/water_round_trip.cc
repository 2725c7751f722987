#include "validation/studies/water_round_trip.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <random>

namespace albtpu {
namespace {

using Eigen::Vector3d;
using Random = std::mt19937_64;

double Uniform(Random& random) { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; }

// `about` turned by the angle whose half has the sine `sin_half`, to a random side.
Vector3d Turned(const Vector3d& about, double sin_half, Random& random) {
  const Vector3d side = about.unitOrthogonal(), other = about.cross(side);
  const double cosine = 1 - 2 * sin_half * sin_half, sine = std::sqrt(1 - cosine * cosine);
  const double turn = 2 * std::numbers::pi * Uniform(random);
  return (cosine * about + sine * (std::cos(turn) * side + std::sin(turn) * other)).normalized();
}

class Traveller {
 public:
  Traveller(const PhaseFunction& phase, const RoundTrip& trip, double x0)
      : phase_(phase), trip_(trip), normal_(Vector3d(trip.slope, 0, -1).normalized()), x0_(x0) {
    critical_ = std::sqrt(1 - 1 / (trip.refractive_index * trip.refractive_index));
  }

  Vector3d at = Vector3d::Zero(), going = Vector3d::UnitZ();
  double path = 0;

  enum class End { kBottom, kSurface, kLost };

  // Travels until it meets the bottom, or the surface under an angle at which it leaves the water.
  End Travel(Random& random) {
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

  // Leaves the bottom as a Lambertian surface sends it.
  void Reflect(Random& random) {
    going = Turned(normal_, std::sqrt((1 - std::sqrt(Uniform(random))) / 2), random);
  }

 private:
  void Go(double way) {
    at += way * going;
    path += way;
  }

  const PhaseFunction& phase_;
  const RoundTrip& trip_;
  Vector3d normal_;
  double x0_, critical_;
};

}  // namespace

std::vector<Echo> TraceRoundTrips(const PhaseFunction& phase, const RoundTrip& trip, double step,
                                  std::uint32_t pools, std::uint32_t photons, std::uint64_t seed) {
  const double sine = std::sin(trip.incidence) / trip.refractive_index;
  const Vector3d down(sine, 0, std::sqrt(1 - sine * sine));
  const double unscattered = trip.depth / down.z(), x0 = unscattered * sine;
  const double lag = std::sin(trip.incidence) / (2 * trip.group_index), cosine = std::cos(trip.incidence);
  const double in_cone = down.z() * std::pow(std::sin(trip.cone), 2);  // of Lambertian light
  std::vector<Echo> echoes(pools, Echo(step));
  tbb::parallel_for(std::uint32_t{0}, pools, [&](std::uint32_t pool) {
    Random random(seed * 1000 + pool);
    Echo& echo = echoes[pool];
    for (std::uint32_t i = 0; i < photons; ++i) {
      Traveller photon(phase, trip, x0);
      const double length = trip.footprint / 4 * std::sqrt(-2 * std::log(Uniform(random)));
      const double angle = 2 * std::numbers::pi * Uniform(random);
      const double entry = length * std::cos(angle) / cosine;
      photon.at = {entry, length * std::sin(angle), 0};
      photon.going = down;
      if (photon.Travel(random) != Traveller::End::kBottom) continue;
      const double ahead = (photon.at.x() - x0) / trip.depth;
      photon.Reflect(random);
      if (photon.Travel(random) != Traveller::End::kSurface) continue;
      if (-photon.going.dot(down) < std::cos(trip.cone)) continue;
      if (std::hypot(photon.at.x() * cosine, photon.at.y()) > trip.field_of_view / 2) continue;
      const double excess = photon.path - 2 * unscattered;
      const double weight = std::exp(-trip.absorption * excess) / in_cone / photons;
      const double time = (excess / 2 + lag * (entry + photon.at.x())) / trip.depth;
      echo.Add(time, ahead, weight);
    }
  });
  return echoes;
}

}  // namespace albtpu
