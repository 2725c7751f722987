#include "generator/water/photon_walk.h"

#include <cmath>
#include <numbers>

#include "generator/math/random_stream.h"

namespace albtpu {

void Heading::Scatter(double sin_half, double turn) {
  const double cosine = 1 - 2 * sin_half * sin_half;
  const double sine = 2 * sin_half * std::sqrt(1 - sin_half * sin_half);
  const double c = sine * std::cos(turn), s = sine * std::sin(turn);
  // Two unit vectors across (x, y, z), without a case for the poles (Duff et al. (2017), "Building an orthonormal
  // basis, revisited", J. Comput. Graph. Tech. 6).
  const double sign = std::copysign(1.0, z), a = -1 / (sign + z), b = x * y * a;
  const double new_x = cosine * x + c * (1 + sign * x * x * a) + s * b;
  const double new_y = cosine * y + c * sign * b + s * (sign + y * y * a);
  const double new_z = cosine * z - c * sign * x - s * y;
  // Rounding adds up over hundreds of turns.
  const double scale = 1.5 - 0.5 * (new_x * new_x + new_y * new_y + new_z * new_z);
  x = new_x * scale;
  y = new_y * scale;
  z = new_z * scale;
}

namespace {

struct Photon {
  Heading heading;
  double x = 0, y = 0, z = 0, path = 0;

  void Move(double length) {
    x += length * heading.x;
    y += length * heading.y;
    z += length * heading.z;
    path += length;
  }
};

// Even in the solid angle of the cone, and in proportion to the cosine of the angle from the vertical.
Heading InCone(const Heading& axis, double cone, UniformStream& random) {
  while (true) {
    Heading heading = axis;
    heading.Scatter(std::sin(cone / 2) * std::sqrt(random.Next()), 2 * std::numbers::pi * random.Next());
    if (random.Next() < heading.z) return heading;
  }
}

}  // namespace

std::vector<Crossings> WalkPhotons(const PhaseFunction& phase, const WalkSetup& setup,
                                   std::span<const double> depths, std::uint32_t photons, std::uint64_t seed,
                                   std::uint32_t cell, std::uint32_t pool) {
  std::vector<Crossings> planes(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    planes[i].depth = depths[i];
    planes[i].launched = photons;
    for (std::vector<float>* column : {&planes[i].excess, &planes[i].ahead, &planes[i].sideways})
      column->reserve(photons);
  }
  const Heading down{std::sin(setup.refracted), 0, std::cos(setup.refracted)};
  const double critical = std::sqrt(1 - 1 / (setup.refractive_index * setup.refractive_index));
  const double longest = depths.back() / down.z + setup.longest_excess;
  for (std::uint32_t number = 0; number < photons; ++number) {
    UniformStream random(seed, cell, number, pool);
    Photon photon;
    photon.heading = setup.cone > 0 ? InCone(down, setup.cone, random) : down;
    std::size_t next = 0;  // the first plane that was not reached yet
    while (photon.path < longest) {
      double free = -std::log(random.Next());
      if (photon.z + free * photon.heading.z < 0) {
        if (-photon.heading.z > critical) break;
        const double way = -photon.z / photon.heading.z;
        photon.Move(way);
        free -= way;
        photon.z = 0;
        photon.heading.z = -photon.heading.z;
      }
      const double end = photon.z + free * photon.heading.z;
      for (; next < depths.size() && depths[next] < end; ++next) {
        Photon there = photon;
        there.Move((depths[next] - photon.z) / photon.heading.z);
        Crossings& plane = planes[next];
        plane.excess.push_back(static_cast<float>(there.path - depths[next] / down.z));
        plane.ahead.push_back(static_cast<float>(there.x - depths[next] * (down.x / down.z)));
        plane.sideways.push_back(static_cast<float>(there.y));
      }
      if (next == depths.size()) break;
      photon.Move(free);
      photon.heading.Scatter(phase.SinHalf(random.Next()), 2 * std::numbers::pi * random.Next());
    }
  }
  return planes;
}

}  // namespace albtpu
