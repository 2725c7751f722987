#include "tests/budget/beams/ray_flight.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "budget/beams/refracted_path.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"

namespace albtpu::testing {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

SimulatedSea::SimulatedSea(double significant_wave_height, double peak_wavelength, std::uint64_t seed) {
  if (significant_wave_height <= 0) return;
  constexpr int kWaves = 64;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double peak = kTurn / peak_wavelength, lowest = 0.6 * peak, highest = 10 * peak;
  const double step = std::log(highest / lowest) / kWaves;
  double variance = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double k = lowest * std::exp(step * (i + uniform(random)));
    const double part = std::pow(k, -3) * std::exp(-1.25 * peak * peak / (k * k)) * k * step;
    double direction = 0;
    do direction = (uniform(random) - 0.5) * std::numbers::pi;
    while (uniform(random) > std::pow(std::cos(direction), 2));
    waves_.push_back({.k = k * Eigen::Vector2d(std::cos(direction), std::sin(direction)),
                      .amplitude = std::sqrt(2 * part),
                      .frequency = std::sqrt(9.81 * k),
                      .phase = kTurn * uniform(random)});
    variance += part;
  }
  for (Wave& wave : waves_) wave.amplitude *= significant_wave_height / 4 / std::sqrt(variance);
}

double SimulatedSea::Elevation(const Eigen::Vector2d& x, double time) const {
  double sum = 0;
  for (const Wave& w : waves_) sum += w.amplitude * std::cos(w.k.dot(x) - w.frequency * time + w.phase);
  return sum;
}

Eigen::Vector2d SimulatedSea::Slope(const Eigen::Vector2d& x, double time) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Wave& w : waves_) sum -= w.k * (w.amplitude * std::sin(w.k.dot(x) - w.frequency * time + w.phase));
  return sum;
}

SimulatedFlight::SimulatedFlight(const FlightPlan& plan) : plan_(plan) {
  std::mt19937_64 random(plan.seed * 977 + 5);
  std::uniform_real_distribution<double> uniform(0, 1);
  // Swings with periods from 4 to 40 s, larger the slower, as turbulence and its correction by a pilot: some 0.3 m/s^2
  // and 1-2 m of each axis.
  for (auto& axis : motion_) {
    for (int i = 0; i < 8; ++i) {
      const double period = 4 * std::pow(10.0, (i + uniform(random)) / 8);
      axis.push_back({plan.wander * 1.0 * std::pow(period / 20, 1.5), kTurn / period, kTurn * uniform(random)});
    }
  }
  for (auto& axis : attitude_)
    for (int i = 0; i < 3; ++i)
      axis.push_back({RadiansOfDegrees(0.8), kTurn / (3 + 9 * uniform(random)), kTurn * uniform(random)});
}

Eigen::Vector3d SimulatedFlight::Position(double time) const {
  const double since = time - plan_.start;
  Eigen::Vector3d position(plan_.speed * since * std::sin(plan_.course), plan_.speed * since * std::cos(plan_.course),
                           plan_.water_height + plan_.height);
  for (int axis = 0; axis < 3; ++axis)
    for (const Swing& swing : motion_[static_cast<std::size_t>(axis)])
      position[axis] += swing.amplitude * std::sin(swing.frequency * since + swing.phase);
  return position;
}

Eigen::Vector3d SimulatedFlight::Attitude(double time) const {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (const Swing& swing : attitude_[static_cast<std::size_t>(axis)])
      angles[axis] += swing.amplitude * std::sin(swing.frequency * (time - plan_.start) + swing.phase);
  return angles;
}

Eigen::Vector3d SimulatedFlight::Beam(double time) const {
  Eigen::Vector3d body;  // Forward, right, down.
  switch (plan_.scanner) {
    case Scanner::kPalmer: {
      const double turn = kTurn * 25 * time, cone = RadiansOfDegrees(20);
      body = {std::sin(cone) * std::cos(turn), std::sin(cone) * std::sin(turn), std::cos(cone)};
      break;
    }
    case Scanner::kEllipse: {
      const double turn = kTurn * 30 * time;
      body = {std::tan(RadiansOfDegrees(14)) * std::cos(turn), std::tan(RadiansOfDegrees(20)) * std::sin(turn), 1};
      break;
    }
    case Scanner::kRaster: {
      const double phase = 20 * time - std::floor(20 * time);
      const double across = RadiansOfDegrees(20) * (4 * std::abs(phase - 0.5) - 1);
      body = {0, std::sin(across), std::cos(across)};
      break;
    }
  }
  const Eigen::Vector3d angles = Attitude(time);
  const Eigen::Vector3d north_east_down = Eigen::AngleAxisd(plan_.course + angles.z(), Eigen::Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                                          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) * body.normalized();
  return {north_east_down.y(), north_east_down.x(), -north_east_down.z()};
}

std::vector<SimulatedRay> SimulatedFlight::Rays() const {
  const SimulatedSea sea(plan_.significant_wave_height, 11, plan_.seed + 100);
  std::mt19937_64 random(plan_.seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal(0, plan_.point_noise);
  const auto noise = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  std::vector<SimulatedRay> rays;
  const auto pulses = static_cast<std::size_t>(plan_.duration * plan_.pairs_per_second);
  for (std::size_t i = 0; i < pulses; ++i) {
    const double time = plan_.start + (static_cast<double>(i) + uniform(random)) / plan_.pairs_per_second;
    const Eigen::Vector3d sensor = Position(time), beam = Beam(time);
    const auto at_height = [&](double height) -> Eigen::Vector3d {
      return sensor + beam * ((height - sensor.z()) / beam.z());
    };
    const Eigen::Vector3d mean_point = at_height(plan_.water_height);
    Eigen::Vector3d surface = mean_point;
    for (int step = 0; step < 3; ++step)
      surface = at_height(plan_.water_height + sea.Elevation(surface.head<2>(), time));
    const Eigen::Vector3d in_water = Refract(beam, NormalOfSlope(sea.Slope(surface.head<2>(), time)), kSeaWaterIndex);
    // A sandy bottom of 4 to 14 m, and a return of the water above it.
    const double depth = 9 + 5 * std::sin(surface.x() / 70 + surface.y() / 110);
    const double upper_depth = 0.6 + (depth - 2.6) * uniform(random);
    ReturnPair pair{.time = time,
                    .upper = surface - in_water * (upper_depth / in_water.z()) + noise(),
                    .lower = surface - in_water * (depth / in_water.z()) + noise()};
    if (uniform(random) < plan_.outliers)
      pair.lower += 3 * Eigen::Vector3d(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    if (const std::optional<AirRay> ray = RayOfPair(pair, plan_.water_height, kSeaWaterIndex))
      rays.push_back({*ray, mean_point});
  }
  return rays;
}

std::vector<AirRay> RaysOf(const std::vector<SimulatedRay>& simulated) {
  std::vector<AirRay> rays;
  for (const SimulatedRay& ray : simulated) rays.push_back(ray.ray);
  return rays;
}

double IncidenceOf(const Eigen::Vector3d& sensor, const Eigen::Vector3d& water_point) {
  const Eigen::Vector3d beam = water_point - sensor;
  return std::atan2(beam.head<2>().norm(), -beam.z());
}

}  // namespace albtpu::testing
