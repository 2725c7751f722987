#include "generator/water/photon_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// Between 1e-6 rad, below which a natural phase function has a thousandth of its light, and 180 degrees.
constexpr double kSmallestAngle = 1e-9;
constexpr int kNodes = 8000;
constexpr std::size_t kGuides = 1 << 16;
// The cosine from the vertical below which a photon counts as this steep. The way of a flatter one to a tilted plane is
// not in proportion to the tilt, and of all light some thousandths are so flat.
constexpr double kFlattest = 0.1;

double Square(double x) { return x * x; }

// The fraction below psi of a Fournier-Forand function of exponent `nu` and index `n` of the particles.
struct FournierForandShare {
  double n, nu;

  double Delta(double sin2_half) const { return 4 * sin2_half / (3 * Square(n - 1)); }

  double operator()(double psi) const {
    const double s = Square(std::sin(psi / 2));
    if (s == 0) return 0;
    const double at_pi = std::pow(Delta(1), nu);
    const double beyond = (1 - at_pi) / (8 * (Delta(1) - 1) * at_pi) * std::cos(psi) * Square(std::sin(psi));
    const double delta = Delta(s);
    if (std::abs(delta - 1) < 1e-5) return (*this)(psi * (1 + 1e-4)) / 2 + (*this)(psi * (1 - 1e-4)) / 2;
    const double power = std::pow(delta, nu);
    return ((1 - power * delta) - (1 - power) * s) / ((1 - delta) * power) + beyond;
  }
};

FournierForandShare OfSlope(double mu) { return {1.01 + 0.1542 * (mu - 3), (3 - mu) / 2}; }

}  // namespace

PhaseFunction::PhaseFunction(const std::function<double(double)>& share_below) : psi_{0} {
  const double step = std::log(kPi / kSmallestAngle) / (kNodes - 1);
  for (int i = 0; i < kNodes - 1; ++i) psi_.push_back(kSmallestAngle * std::exp(i * step));
  psi_.push_back(kPi);
  for (const double psi : psi_) {
    sin2_half_.push_back(Square(std::sin(psi / 2)));
    share_.push_back(psi == 0 ? 0 : std::clamp(share_below(psi), share_.back(), 1.0));
  }
  share_.back() = 1;
  guide_.resize(kGuides + 1);
  std::uint32_t node = 0;
  for (std::size_t i = 0; i <= kGuides; ++i) {
    const double share = static_cast<double>(i) / kGuides;
    while (node + 2 < share_.size() && share_[node + 1] <= share) ++node;
    guide_[i] = node;
  }
}

PhaseFunction PhaseFunction::FournierForand(double backscatter_fraction) {
  // The fraction grows with the slope of the sizes.
  double least = 3.01, most = 4.9;
  for (int i = 0; i < 60; ++i) {
    const double middle = (least + most) / 2;
    (1 - OfSlope(middle)(kRightAngle) < backscatter_fraction ? least : most) = middle;
  }
  return PhaseFunction(OfSlope((least + most) / 2));
}

PhaseFunction PhaseFunction::HenyeyGreenstein(double g) {
  // 1 + g^2 - 2 g cos(psi) = (1 - g)^2 + 4 g sin^2(psi / 2), without the cancellation at small angles.
  return PhaseFunction([g](double psi) {
    const double root = std::sqrt(Square(1 - g) + 4 * g * Square(std::sin(psi / 2)));
    const double below = 4 * g * Square(std::sin(psi / 2)) / (root + 1 - g);  // root - (1 - g)
    return (1 + g) / (2 * g) * below / root;
  });
}

double PhaseFunction::ShareBelow(double psi) const {
  const auto above = std::upper_bound(psi_.begin() + 1, psi_.end() - 1, psi);
  const auto i = static_cast<std::size_t>(above - psi_.begin());
  const double fraction = (Square(std::sin(psi / 2)) - sin2_half_[i - 1]) / (sin2_half_[i] - sin2_half_[i - 1]);
  return share_[i - 1] + std::clamp(fraction, 0.0, 1.0) * (share_[i] - share_[i - 1]);
}

// Light between two nodes is even in sin^2(psi / 2), as SinHalf draws it.
template <typename Value>
double PhaseFunction::Mean(const Value& value) const {
  double sum = 0;
  for (std::size_t i = 1; i < psi_.size(); ++i) {
    const double middle = value((sin2_half_[i - 1] + sin2_half_[i]) / 2);
    const double mean = (value(sin2_half_[i - 1]) + 4 * middle + value(sin2_half_[i])) / 6;
    sum += (share_[i] - share_[i - 1]) * mean;
  }
  return sum;
}

double PhaseFunction::MeanCosine() const {
  return 1 - Mean([](double sin2_half) { return 2 * sin2_half; });
}

double PhaseFunction::MeanSecondLegendre() const {
  // (3 cos^2 - 1) / 2 with cos = 1 - 2 s.
  return 1 - Mean([](double sin2_half) { return 6 * sin2_half * (1 - sin2_half); });
}

double PhaseFunction::MeanSquareAngle() const {
  return Mean([](double sin2_half) { return Square(2 * std::asin(std::sqrt(sin2_half))); });
}

double PhaseFunction::SinHalf(double share) const {
  std::size_t i = guide_[static_cast<std::size_t>(share * kGuides)];
  while (share_[i + 1] <= share && i + 2 < share_.size()) ++i;
  const double rise = share_[i + 1] - share_[i];
  const double fraction = rise > 0 ? (share - share_[i]) / rise : 0;
  return std::sqrt(sin2_half_[i] + fraction * (sin2_half_[i + 1] - sin2_half_[i]));
}

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

std::vector<Crossings> WalkPhotons(const PhaseFunction& phase, const WalkSetup& setup, std::span<const double> depths,
                                   std::uint32_t photons, std::uint64_t seed, std::uint32_t cell, std::uint32_t pool) {
  std::vector<Crossings> planes(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    planes[i].depth = depths[i];
    planes[i].launched = photons;
    Crossings& plane = planes[i];
    for (std::vector<float>* column : {&plane.excess, &plane.ahead, &plane.sideways, &plane.forward, &plane.sidelong})
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
        const double down_least = std::max(there.heading.z, kFlattest);
        plane.forward.push_back(static_cast<float>(there.heading.x / down_least));
        plane.sidelong.push_back(static_cast<float>(there.heading.y / down_least));
      }
      if (next == depths.size()) break;
      photon.Move(free);
      photon.heading.Scatter(phase.SinHalf(random.Next()), 2 * std::numbers::pi * random.Next());
    }
  }
  return planes;
}

}  // namespace albtpu
