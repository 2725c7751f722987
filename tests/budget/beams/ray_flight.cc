#include "tests/budget/beams/ray_flight.h"

#include <cmath>
#include <optional>

#include "tests/flights/beam_path.h"

namespace albtpu::testing {
namespace {

constexpr double kScanRate = 25;  // Hz

Aircraft AircraftOf(const FlightPlan& plan) {
  RandomNumbers random(plan.seed * 977 + 5);
  return {AreaChart(0, 0),
          {.course = plan.course, .height = plan.water_height + plan.height, .speed = plan.speed, .drift = plan.drift},
          random};
}

}  // namespace

// Swings with periods from 4 to 40 s, larger the slower, as turbulence and its correction by a pilot: some 0.3 m/s^2.
SimulatedFlight::SimulatedFlight(const FlightPlan& plan) : plan_(plan), aircraft_(AircraftOf(plan)) {
  RandomNumbers random(plan.seed * 977 + 6);
  for (int axis = 0; axis < 3; ++axis) {
    const SmoothMotion fast(0, 0.2 * plan.drift, 0.5, 1.6, 4, random);
    swings_.push_back(SmoothMotion(0, 1.2 * plan.drift, 0.16, 0.5, 4, random).Plus(fast));
  }
}

Eigen::Vector3d SimulatedFlight::Position(double time) const {
  const double since = time - plan_.start;
  return aircraft_.InChart(since) + Eigen::Vector3d(swings_[0].At(since), swings_[1].At(since), swings_[2].At(since));
}

std::vector<SimulatedRay> SimulatedFlight::Rays() const {
  RandomNumbers random(plan_.seed);
  const WavySurface sea(plan_.significant_wave_height, 0, random);
  const auto draw = [&] { return random.Uniform(0, 1); };
  const auto noise = [&]() -> Eigen::Vector3d {
    return plan_.point_noise * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
  };
  std::vector<SimulatedRay> rays;
  const auto pulses = static_cast<std::size_t>(plan_.duration * plan_.pairs_per_second);
  for (std::size_t i = 0; i < pulses; ++i) {
    const double since = (static_cast<double>(i) + draw()) / plan_.pairs_per_second;
    const Eigen::Vector3d sensor = Position(plan_.start + since);
    const Eigen::Vector3d north_east_down =
        Attitude(aircraft_.Angles(since)) * BeamDirection(plan_.scanner, kScanRate * since);
    const Eigen::Vector3d beam(north_east_down.y(), north_east_down.x(), -north_east_down.z());
    const auto at_height = [&](double height) -> Eigen::Vector3d {
      return sensor + beam * ((height - sensor.z()) / beam.z());
    };
    const Eigen::Vector3d mean_point = at_height(plan_.water_height);
    // Newton's method: a step errs by half the curvature times the square of the last, some 1e-4 m after the first.
    Eigen::Vector3d surface = mean_point;
    Eigen::Vector2d slope;
    for (int step = 0; step < 2; ++step) {
      const WavySurface::Local local = sea.At(surface.head<2>(), since);
      slope = local.slope;
      const double above = surface.z() - plan_.water_height - local.elevation;
      surface -= beam * (above / (beam.z() - slope.dot(beam.head<2>())));
    }
    const Eigen::Vector3d in_water = Refract(beam, Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized());
    // A sandy bottom of 4 to 14 m, and a return of the water above it.
    const double depth = 9 + 5 * std::sin(surface.x() / 70 + surface.y() / 110);
    const double upper_depth = 0.6 + (depth - 2.6) * draw();
    ReturnPair pair{.time = plan_.start + since,
                    .upper = surface - in_water * (upper_depth / in_water.z()) + noise(),
                    .lower = surface - in_water * (depth / in_water.z()) + noise()};
    if (draw() < plan_.outliers) pair.lower += 3 * Eigen::Vector3d(draw() - 0.5, draw() - 0.5, draw() - 0.5);
    if (const std::optional<AirRay> ray = RayOfPair(pair, plan_.water_height, kIndexOfWater))
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
