#include "validation/studies/water_round_trip.h"

#include <tbb/parallel_for.h>

namespace albtpu {
std::vector<Echo> TraceRoundTrips(const PhaseFunction& phase, const RoundTrip& trip, double step, std::uint32_t pools,
                                  std::uint32_t photons, std::uint64_t seed) {
  const double sine = std::sin(trip.incidence) / trip.refractive_index;
  const Eigen::Vector3d down(sine, 0, std::sqrt(1 - sine * sine));
  const double unscattered = trip.depth / down.z(), x0 = unscattered * sine;
  const double lag = std::sin(trip.incidence) / (2 * trip.group_index), cosine = std::cos(trip.incidence);
  const double in_cone = down.z() * std::pow(std::sin(trip.cone), 2);  // of Lambertian light
  std::vector<Echo> echoes(pools, Echo(step));
  tbb::parallel_for(std::uint32_t{0}, pools, [&](std::uint32_t pool) {
    std::mt19937_64 random(seed * 1000 + pool);
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
      echo.Add(time, ahead, weight, {.delay = ahead / down.z()});
    }
  });
  return echoes;
}

}  // namespace albtpu
