#include "budget/air/air_sources.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

// The rays of a pulse and what turns errors of the aircraft into those of the point.
struct Rays {
  explicit Rays(const AirPulse& pulse) : n(pulse.index) {
    const double incidence = pulse.incidence * kDegree, azimuth = pulse.beam_azimuth * kDegree;
    u << std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth), std::cos(incidence);
    const double horizontal = u.x() * u.x() + u.y() * u.y();
    const double down = std::sqrt(1 - horizontal / (n * n));
    w << u.x() / n, u.y() / n, down;
    slant_range = pulse.altitude / u.z();
    water_path = pulse.depth / down;
    k = u - w / n;
    w_by_u << 1 / n, 0, 0, 0, 1 / n, 0, -u.x() / (n * n * down), -u.y() / (n * n * down), 0;
    w_by_n << -u.x() / (n * n), -u.y() / (n * n), horizontal / (n * n * n * down);
    // A turn about the vertical, which leaves no doubt at nadir.
    across << Vector3d(std::cos(incidence) * std::cos(azimuth), std::cos(incidence) * std::sin(azimuth),
                       -std::sin(incidence)),
        Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
  }

  // dB/dO: the surface stays where it is if its height is given.
  Matrix3d ByPosition(bool given) const {
    Matrix3d p = Matrix3d::Identity();
    if (given) p.col(2) -= k / u.z();
    return p;
  }
  // dB/du.
  Matrix3d ByDirection(bool given) const {
    Matrix3d g = slant_range * Matrix3d::Identity() + water_path * w_by_u;
    if (given) g.col(2) -= slant_range / u.z() * k;
    return g;
  }

  double n;
  Vector3d u, w, k, w_by_n;
  double slant_range, water_path;
  Matrix3d w_by_u;
  Eigen::Matrix<double, 3, 2> across;  // Two unit vectors across the beam.
};

}  // namespace

Vector3d ErrorOfSurfaceHeight(const AirPulse& pulse) {
  const Rays rays(pulse);
  return -rays.k / rays.u.z();
}

std::vector<AirSource> AirSources(const AirPulse& pulse, SurfaceLocation located, const AirErrors& errors) {
  const Rays rays(pulse);
  const bool given = located == SurfaceLocation::kLevel;
  const Matrix3d by_position = rays.ByPosition(given), by_direction = rays.ByDirection(given);
  const Matrix3d scan_by_direction = rays.ByDirection(located != SurfaceLocation::kPulse);
  const Eigen::AngleAxisd heading(pulse.heading * kDegree, Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(pulse.pitch * kDegree, Vector3d::UnitY());
  const Eigen::AngleAxisd roll(pulse.roll * kDegree, Vector3d::UnitX());
  const Matrix3d attitude = (heading * pitch * roll).toRotationMatrix();
  const Vector3d lever_arm = attitude * pulse.lever_arm;
  const Vector3d rates = attitude * (pulse.rates * kDegree);

  std::vector<AirSource> sources;
  const auto add = [&](auto member, const Matrix3Xd& columns) {
    const ErrorSource& source = kErrorSources[Index(member)];
    sources.push_back({source.name, GroupOf(source, located), columns});
  };
  add(&AirErrors::position, by_position * Vector3d(errors.position.data()).asDiagonal());
  const Vector3d axes[] = {attitude.col(0), heading * Vector3d::UnitY(), Vector3d::UnitZ()};
  Matrix3d turns;
  for (int i = 0; i < 3; ++i)
    turns.col(i) = by_direction * axes[i].cross(rays.u) + by_position * axes[i].cross(lever_arm);
  add(&AirErrors::attitude, turns * (kDegree * Vector3d(errors.attitude.data())).asDiagonal());
  for (int i = 0; i < 3; ++i) turns.col(i) = by_direction * attitude.col(i).cross(rays.u);
  add(&AirErrors::boresight, turns * (kDegree * Vector3d(errors.boresight.data())).asDiagonal());
  add(&AirErrors::lever_arm, errors.lever_arm * by_position * attitude);
  add(&AirErrors::scan, errors.scan * kDegree * scan_by_direction * rays.across);
  add(&AirErrors::time,
      errors.time * (by_position * (pulse.velocity + rates.cross(lever_arm)) + by_direction * rates.cross(rays.u)));
  add(&AirErrors::range_offset, errors.range_offset * (given ? Vector3d(rays.w / rays.n) : rays.u));
  add(&AirErrors::bottom_range, errors.bottom_range / rays.n * rays.w);
  if (located == SurfaceLocation::kPulse) add(&AirErrors::surface_range, errors.surface_range * rays.k);
  add(&AirErrors::surface_height, errors.surface_height * -rays.k / rays.u.z());
  add(&AirErrors::index, errors.index * rays.water_path * (rays.w_by_n - rays.w / rays.n));
  return sources;
}

AirConstants::AirConstants(const AirErrors& errors, SurfaceLocation located, double n,
                           const std::array<double, 3>& lever) {
  const auto single = [](double value) { return static_cast<float>(value); };
  inverse_index = single(1 / n);
  inverse_square_index = single(1 / (n * n));
  given = located == SurfaceLocation::kLevel ? 1 : 0;
  scan_given = located == SurfaceLocation::kPulse ? 0 : 1;
  forward = single(lever[0]);
  right = single(lever[1]);
  down = single(lever[2]);
  auto sigma = sigmas.begin();
  for (const ErrorSource& source : kErrorSources) {
    const double scale = source.unit == "degree" ? kDegree : 1;
    for (const double number : source.In(errors)) *sigma++ = single(scale * number);
  }
  if (located != SurfaceLocation::kPulse) sigmas[FirstNumber(&AirErrors::surface_range)] = 0;
  for (std::size_t group = 0; group < kErrorGroups; ++group) {
    const bool here = static_cast<std::size_t>(located) == group;
    surface_height[group] = here ? single(errors.surface_height) : 0;
  }
}

}  // namespace albtpu
