#include "budget/beams/ray_track.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <tuple>

#include "sea/angle.h"
#include "tests/budget/beams/ray_flight.h"
#include "tests/every_case.h"

namespace albtpu {
namespace {

// The standard deviation [rad] of the incidence of a beam from `sensor` to `water_point` by the error of the position:
// a displacement e changes the angle from the vertical by e . (horizontal, up unit vector across the beam) / range.
double IncidenceSigma(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& sensor,
                      const Eigen::Vector3d& water_point) {
  const Eigen::Vector3d beam = water_point - sensor;
  const double range = beam.norm(), distance = beam.head<2>().norm();
  if (!(distance > 0)) return std::sqrt(covariance.topLeftCorner<2, 2>().trace() / 2) / range;
  Eigen::Vector3d across;
  across << beam.head<2>() * (beam.z() / distance), -distance;
  across /= range * range;
  return std::sqrt(across.dot(covariance * across));
}

using testing::Ask;
using testing::FlightPlan;
using testing::IncidenceOf;
using testing::RaysOf;
using testing::ScannerKind;
using testing::SimulatedFlight;
using testing::SimulatedRay;

// Errors of incidence, in degrees, of a beam every two seconds, so that no two have a knot in common.
struct Errors {
  double squares = 0, worst = 0, sigma_squares = 0;
  int windows = 0, covered = 0, uncertain = 0;

  double Rms() const { return std::sqrt(squares / windows); }
  double Sigma() const { return std::sqrt(sigma_squares / windows); }
  double Coverage() const { return static_cast<double>(covered) / windows; }
};

void Compare(const SimulatedFlight& flight, const std::vector<SimulatedRay>& rays, const RayTrack& track,
             Errors& errors) {
  double next = 0;
  for (const SimulatedRay& ray : rays) {
    if (ray.ray.time < next) continue;
    next = ray.ray.time + 2;
    const auto at = track.At(ray.ray.time);
    if (!at || at->incidence_sigma > RadiansOfDegrees(0.3)) {
      ++errors.uncertain;
      continue;
    }
    const double error = DegreesOfRadians(IncidenceOf(at->position, ray.true_water_point) -
                                          IncidenceOf(flight.Position(ray.ray.time), ray.true_water_point));
    const double sigma = DegreesOfRadians(IncidenceSigma(at->covariance, at->position, ray.true_water_point));
    errors.squares += error * error;
    errors.sigma_squares += sigma * sigma;
    errors.worst = std::max(errors.worst, std::abs(error));
    errors.covered += std::abs(error) < 1.96 * sigma;
    ++errors.windows;
  }
}

// Flights at 200 to 600 m and 56 to 80 m/s, with all three scanners in turn.
Errors FlyMany(int flights, FlightPlan plan) {
  Errors errors;
  for (int i = 0; i < flights; ++i) {
    plan.scanner = static_cast<ScannerKind>(i % 3);
    plan.seed = static_cast<std::uint64_t>(i + 1);
    plan.height = 200 + 400 * ((i * 37) % 100) / 100.0;
    plan.speed = 56 + 24 * ((i * 53) % 100) / 100.0;
    plan.course = 1.1 * i;
    const SimulatedFlight flight(plan);
    const auto rays = flight.Rays();
    Compare(flight, rays, FitTrack(RaysOf(rays)), errors);
  }
  return errors;
}

TEST(RayTrack, IsExactWithoutErrors) {
  const SimulatedFlight flight({.duration = 15, .point_noise = 0, .drift = 0.5});
  const auto rays = flight.Rays();
  Errors errors;
  Compare(flight, rays, FitTrack(RaysOf(rays)), errors);
  // What is left is the cubic over 1.5 s of swings of up to 1.6 rad/s, of which each has 0.1 m / sqrt(2):
  // (1.5 x 1.6)^4 / 384 of it, 6 mm, at the fastest; at 1.2 rad/s, 2 mm.
  EXPECT_LT(errors.worst, DegreesOfRadians(0.003 / 400));
}

TEST(RayTrack, OverFlatWaterIsWithinThreeHundredthsOfADegree) {
  const Errors errors = FlyMany(30, {.duration = 20, .pairs_per_second = 500});
  EXPECT_LT(errors.Rms(), 0.03);
  EXPECT_LT(errors.worst, 0.3);
  EXPECT_EQ(errors.uncertain, 0);
}

TEST(RayTrack, OverWavesIsWithinAQuarterOfADegree) {
  const Errors errors = FlyMany(15, {.duration = 20, .pairs_per_second = 500, .significant_wave_height = 0.3});
  EXPECT_LT(errors.Rms(), 0.25);
  EXPECT_EQ(errors.uncertain, 0);
}

// Errors fall as the root of the number of pairs where pairs decide, more slowly where the smoothness of flight helps:
// ten times as many pairs divide them by 1.5 or more.
TEST(RayTrack, GetsBetterWithMorePairs) {
  std::printf("incidence error (rms, worst), its sigma [degree], share without number\n");
  std::printf("%8s %24s %34s\n", "pairs/s", "flat water", "waves of Hs 0.3 m");
  Errors before[2];
  for (const double rate : {10.0, 100.0, 1000.0}) {
    std::printf("%8.0f", rate);
    for (int sea = 0; sea < 2; ++sea) {
      const Errors errors =
          FlyMany(9, {.duration = 20, .pairs_per_second = rate, .significant_wave_height = 0.3 * sea});
      const double silent = static_cast<double>(errors.uncertain) / (errors.uncertain + errors.windows);
      std::printf("   %.3f %.3f  %.3f %5.1f %%", errors.Rms(), errors.worst, errors.Sigma(), 100 * silent);
      if (rate > 10) {
        EXPECT_LT(errors.Rms(), before[sea].Rms() / 1.5) << rate;
      }
      before[sea] = errors;
    }
    std::printf("\n");
  }
}

// 13 windows of 18 flights have a binomial standard error of 1.4 %.
TEST(RayTrack, ItsSigmaCoversTheTrueError) {
  const int flights = albtpu::testing::EveryCase() ? 36 : 18;
  for (const auto& [water, plan] :
       {std::pair("flat water", FlightPlan{.duration = 30, .pairs_per_second = 150}),
        {"waves", {.duration = 30, .pairs_per_second = 150, .significant_wave_height = 0.3}},
        {"outliers", {.duration = 30, .pairs_per_second = 150, .significant_wave_height = 0.3, .outliers = 0.3}}}) {
    const Errors errors = FlyMany(flights, plan);
    std::printf("%s: %d windows, %.1f %% within 1.96 sigma\n", water, errors.windows, 100 * errors.Coverage());
    EXPECT_GE(errors.windows, 13 * flights) << water;
    EXPECT_NEAR(errors.Coverage(), 0.95, 0.03) << water;
    EXPECT_LT(errors.Rms(), 0.25) << water;
  }
}

// Water on one side only, and in patches: the rest is land.
TEST(RayTrack, ItsSigmaCoversTheTrueErrorAlongAShore) {
  const int flights = albtpu::testing::EveryCase() ? 30 : 18;
  Errors errors;
  for (int i = 0; i < flights; ++i) {
    const FlightPlan plan{.scanner = static_cast<ScannerKind>(i % 3),
                          .height = 200.0 + 240 * i / flights,
                          .course = 0,
                          .duration = 30,
                          .pairs_per_second = 600,
                          .significant_wave_height = 0.3 * (i % 2),
                          .seed = static_cast<std::uint64_t>(i + 1)};
    const SimulatedFlight flight(plan);
    auto rays = flight.Rays();
    std::erase_if(rays, [](const SimulatedRay& ray) {
      return ray.true_water_point.x() < 20 || std::fmod(ray.ray.time, 4) < 1.5;
    });
    Compare(flight, rays, FitTrack(RaysOf(rays)), errors);
  }
  std::printf("shore: %d windows, %.1f %% within 1.96 sigma, %d without number\n", errors.windows,
              100 * errors.Coverage(), errors.uncertain);
  EXPECT_GE(errors.windows, 8 * flights);
  EXPECT_NEAR(errors.Coverage(), 0.95, 0.03);
}

TEST(RayTrack, DoesNotDependOnTheOrderOfRays) {
  const SimulatedFlight flight({.duration = 5});
  auto rays = RaysOf(flight.Rays());
  const RayTrack sorted = FitTrack(rays);
  std::shuffle(rays.begin(), rays.end(), std::mt19937_64(1));
  EXPECT_EQ(FitTrack(rays).At(1002)->position, sorted.At(1002)->position);
}

TEST(RayTrack, HasASegmentForEachLineAndNothingBetween) {
  const SimulatedFlight first({.start = 1000, .duration = 10, .seed = 1});
  const SimulatedFlight second({.height = 300, .course = 3.4, .start = 1100, .duration = 12, .seed = 2});
  auto rays = RaysOf(second.Rays());
  const auto more = RaysOf(first.Rays());
  rays.insert(rays.end(), more.begin(), more.end());
  const RayTrack track = FitTrack(rays);
  ASSERT_EQ(track.segments().size(), 2u);
  EXPECT_NEAR(track.At(1005)->height, 400, 15);  // Swings of 1 m and more are part of the flight.
  EXPECT_NEAR(track.At(1106)->height, 300, 15);
  using enum TrackOutcome;
  EXPECT_EQ(Ask(track, {900, 1005, 1050, 1106, 1200, std::nan("")}).outcomes,
            (std::vector{kOutside, kKnown, kOutside, kKnown, kOutside, kOutside}));
  EXPECT_FALSE(track.At(1050));
}

TEST(RayTrack, AnswersInColumnsAsForOneTime) {
  const SimulatedFlight flight({.duration = 10});
  const RayTrack track = FitTrack(RaysOf(flight.Rays()));
  std::vector<double> times;
  for (double t = 1000.1; t < 1009.8; t += 0.07) times.push_back(t);
  const auto [positions, outcomes] = Ask(track, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto at = track.At(times[i]);
    ASSERT_EQ(outcomes[i], TrackOutcome::kKnown);
    EXPECT_LT((Eigen::Vector3d(positions[i].x, positions[i].y, positions[i].z) - at->position).norm(), 1e-9);
    // Interpolated between eighths of an interval of the knots, over which it varies by some percent.
    EXPECT_NEAR(positions[i].incidence_sigma / at->incidence_sigma, 1, 0.05);
  }
}

TEST(RayTrack, SaysWhereItIsUncertain) {
  // Ten pairs a second over waves, and none for four seconds.
  const SimulatedFlight flight({.duration = 30, .pairs_per_second = 10, .significant_wave_height = 0.3});
  auto rays = RaysOf(flight.Rays());
  std::erase_if(rays, [](const AirRay& ray) { return ray.time > 1012 && ray.time < 1016; });
  const RayTrack track = FitTrack(rays);
  ASSERT_EQ(track.segments().size(), 1u);
  EXPECT_EQ(Ask(track, {1014}).outcomes[0], TrackOutcome::kUncertain);
}

TEST(RayTrack, DoesNotBelieveInWhatIsNoAircraft) {
  for (const FlightPlan& plan : {FlightPlan{.height = 12, .duration = 5}, FlightPlan{.speed = 260, .duration = 5}}) {
    const SimulatedFlight flight(plan);
    const RayTrack track = FitTrack(RaysOf(flight.Rays()));
    EXPECT_NE(Ask(track, {1002.5}).outcomes[0], TrackOutcome::kKnown) << plan.height;
  }
}

TEST(RayTrack, NeedsEnoughRays) {
  const SimulatedFlight flight({.duration = 2});
  auto rays = RaysOf(flight.Rays());
  rays.resize(19);
  EXPECT_TRUE(FitTrack(rays).segments().empty());
  EXPECT_TRUE(FitTrack({}).segments().empty());
  std::vector<AirRay> same(100, rays[0]);
  EXPECT_TRUE(FitTrack(same).segments().empty());
}

TEST(RayTrack, FitsSegmentsOfHalfASecond) {
  const SimulatedFlight flight({.duration = 0.5, .pairs_per_second = 1000});
  const auto rays = flight.Rays();
  Errors errors;
  Compare(flight, rays, FitTrack(RaysOf(rays)), errors);
  EXPECT_EQ(errors.windows, 1);
  EXPECT_LT(errors.worst, 0.3);
}

TEST(IncidenceSigma, AgreesWithDifferencesOfTheIncidence) {
  const Eigen::Vector3d sensor(10, 20, 400), water(100, -60, 2);
  Eigen::Matrix3d covariance;
  covariance << 4, 1, -0.5, 1, 3, 0.2, -0.5, 0.2, 2;
  Eigen::Vector3d gradient;
  constexpr double kStep = 1e-3;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (IncidenceOf(sensor + step, water) - IncidenceOf(sensor - step, water)) / (2 * kStep);
  }
  EXPECT_NEAR(IncidenceSigma(covariance, sensor, water), std::sqrt(gradient.dot(covariance * gradient)), 1e-9);
}

}  // namespace
}  // namespace albtpu
