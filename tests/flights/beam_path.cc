#include "tests/flights/beam_path.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr double kResolution = 2e-9;  // m; heights are differences of numbers near 6.4e6 m.
constexpr int kMaxSteps = 50;         // The slope of the seabed makes an error at least 5 times smaller a step.

}  // namespace

double Coast::HeightAt(const Eigen::Vector2d& east_north) const {
  const double along = east_north.x() * std::sin(course) + east_north.y() * std::cos(course);
  const double across = east_north.x() * std::cos(course) - east_north.y() * std::sin(course);
  const double slope = deepest * (along - shoreline) / (deepest_at - shoreline);
  return water_level - slope - 0.3 * std::sin(0.05 * along) * std::sin(0.03 * across);
}

WavySurface::WavySurface(double height, double towards, RandomNumbers& random) {
  if (height == 0) return;
  constexpr int kWaves = 48;
  constexpr double kPeak = 10, kLongest = 20, kShortest = 1;  // m
  constexpr double kStandardGravity = 9.80665;                // m/s^2, exact (CGPM 1901).
  // Wavenumbers in equal steps of ln k, each with the variance k^-3 k d(ln k) exp(-1.25 (k_p / k)^2).
  double variance = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double fraction = (i + random.Uniform(0, 1)) / kWaves;
    const double length = kLongest * std::pow(kShortest / kLongest, fraction);
    const double k = 2 * std::numbers::pi / length;
    const double share = std::exp(-1.25 * length * length / (kPeak * kPeak)) / (k * k);
    const double direction = towards + random.Uniform(-1, 1) * std::numbers::pi / 3;
    variance += share;
    waves_.push_back({std::sqrt(2 * share),
                      {k * std::sin(direction), k * std::cos(direction)},
                      std::sqrt(kStandardGravity * k),
                      random.Uniform(0, 2 * std::numbers::pi)});
  }
  // Hs is four standard deviations.
  const double factor = height / 4 / std::sqrt(variance);
  for (Wave& wave : waves_) wave.amplitude *= factor;
}

WavySurface::Local WavySurface::At(const Eigen::Vector2d& east_north, double time) const {
  Local local;
  for (const Wave& wave : waves_) {
    const double phase = wave.wavenumber.dot(east_north) - wave.frequency * time + wave.phase;
    local.elevation += wave.amplitude * std::sin(phase);
    local.slope += wave.amplitude * std::cos(phase) * wave.wavenumber;
  }
  return local;
}

// The part of the beam along the surface becomes 1/n of itself, sin(t) = sin(i)/n; the length stays 1.
Eigen::Vector3d Refract(const Eigen::Vector3d& beam, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along = (beam - beam.dot(normal) * normal) / kIndexOfWater;
  return along - std::sqrt(1 - along.squaredNorm()) * normal;
}

BeamPath PathToWater(const Scene& scene, const Eigen::Vector3d& sensor, const Eigen::Vector3d& beam, double time) {
  BeamPath path;
  for (int step = 0; step < kMaxSteps; ++step) {
    path.water_point = sensor + path.slant_range * beam;
    const Geodetic here = GeodeticFrom(path.water_point);
    const WavySurface::Local local = scene.waves.At(scene.chart.EastNorth(here), time);
    const Eigen::Matrix3d axes = EastNorthUp(here.latitude, here.longitude);
    const Eigen::Vector3d east = axes.col(0), north = axes.col(1), up = axes.col(2);
    const Eigen::Vector3d normal = (up - local.slope.x() * east - local.slope.y() * north).normalized();
    path.water_direction = Refract(beam, normal);
    path.incidence = std::atan2(beam.cross(up).norm(), -beam.dot(up));
    path.azimuth = std::atan2(beam.dot(east), beam.dot(north));
    const double above = here.height - scene.coast.water_level - local.elevation;
    if (std::abs(above) < kResolution) break;
    // How fast the beam comes nearer to the tilted surface.
    path.slant_range += above / -(beam.dot(up) - local.slope.x() * beam.dot(east) - local.slope.y() * beam.dot(north));
  }
  return path;
}

double DistanceToGround(const Scene& scene, const Eigen::Vector3d& begin, const Eigen::Vector3d& beam) {
  double distance = 0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Geodetic here = GeodeticFrom(begin + distance * beam);
    const double above = here.height - scene.coast.HeightAt(scene.chart.EastNorth(here));
    if (std::abs(above) < kResolution) break;
    distance += above / -beam.dot(EastNorthUp(here.latitude, here.longitude).col(2));
  }
  return distance;
}

}  // namespace albtpu::testing
