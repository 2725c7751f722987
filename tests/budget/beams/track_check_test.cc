#include "budget/beams/track_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "sea/angle.h"
#include "tests/budget/beams/ray_flight.h"
#include "tests/every_case.h"

namespace albtpu {
namespace {

using Eigen::Vector3d;
using testing::FlightPlan;
using ::testing::HasSubstr;
using testing::RaysOf;
using testing::ScannerKind;
using testing::SimulatedFlight;

// Of each ray the check asks for hundreds of positions, and a flight is made of dozens of sinusoids. Positions every
// 0.02 s and straight lines between them are off by 0.02 mm where the aircraft accelerates by 0.4 m/s^2.
class SampledFlight {
 public:
  explicit SampledFlight(const FlightPlan& plan) : flight_(plan) {
    for (double time = plan.start - kMargin; time < plan.start + plan.duration + kMargin; time += kStep)
      positions_.push_back(flight_.Position(time));
  }

  Vector3d Position(double time) const {
    const double at = (time - plan().start + kMargin) / kStep;
    if (!(at >= 0 && at + 1 < static_cast<double>(positions_.size()))) return flight_.Position(time);
    const auto before = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(before);
    return (1 - share) * positions_[before] + share * positions_[before + 1];
  }
  const FlightPlan& plan() const { return flight_.plan(); }

 private:
  static constexpr double kStep = 0.02, kMargin = 50;  // s; the search goes 20 s beyond what is wrong by 18 s.
  SimulatedFlight flight_;
  std::vector<Vector3d> positions_;
};

TrackPositions Columns(const std::function<Vector3d(double)>& position) {
  return [position](std::span<const double> times, std::span<Vector3d> positions) {
    for (std::size_t i = 0; i < times.size(); ++i) positions[i] = position(times[i]);
  };
}

// A flight of each scanner at 250 m, over flat water and over waves, and tracks that are wrong in one way.
class TrackCheckOf : public ::testing::TestWithParam<std::tuple<ScannerKind, double>> {
 protected:
  TrackCheckOf() : flown_(FlownOnce()), flight_(flown_.flight), rays_(flown_.rays) {}

  TrackCheck Check(const std::function<Vector3d(double)>& position) const {
    return CheckTrack(rays_, Columns(position));
  }
  TrackCheck Moved(double forward, double right, double up) const {
    const double course = flight_.plan().course;
    const Vector3d move(forward * std::sin(course) + right * std::cos(course),
                        forward * std::cos(course) - right * std::sin(course), up);
    return Check([&, move](double t) -> Vector3d { return flight_.Position(t) + move; });
  }

 private:
  struct Flown {
    explicit Flown(const FlightPlan& plan) : flight(plan), rays(RaysOf(SimulatedFlight(plan).Rays())) {}
    const SampledFlight flight;
    const std::vector<AirRay> rays;
  };
  static const Flown& FlownOnce() {
    static std::map<ParamType, Flown> flown;
    const auto& [scanner, wave_height] = GetParam();
    return flown
        .try_emplace(GetParam(), FlightPlan{.scanner = scanner,
                                            .height = 250,
                                            .pairs_per_second = 100,
                                            .significant_wave_height = wave_height,
                                            .seed = 7})
        .first->second;
  }
  const Flown& flown_;

 protected:
  const SampledFlight& flight_;
  const std::vector<AirRay>& rays_;
};

INSTANTIATE_TEST_SUITE_P(Flights, TrackCheckOf,
                         ::testing::Values(std::tuple(ScannerKind::kCone, 0.3), std::tuple(ScannerKind::kEllipse, 0.0),
                                           std::tuple(ScannerKind::kRaster, 0.0),
                                           std::tuple(ScannerKind::kRaster, 0.3)));

TEST_P(TrackCheckOf, ARightTrackAgrees) {
  const TrackCheck check = Moved(0, 0, 0);
  EXPECT_EQ(check.verdict, TrackVerdict::kAgrees) << Describe(check);
  const double limit = std::get<1>(GetParam()) > 0 ? 0.15 : 0.03;
  EXPECT_LT(std::abs(DegreesOfRadians(check.mean_difference.value)), limit);
}

TEST_P(TrackCheckOf, ATrackInUtcIsNamed) {
  // What carries the time t was measured 18 s later.
  const TrackCheck check = Check([&](double t) { return flight_.Position(t + 18); });
  EXPECT_EQ(check.verdict, TrackVerdict::kTimeOffset) << Describe(check);
  EXPECT_NEAR(check.time.value, -18, 0.05);
  EXPECT_THAT(Describe(check), HasSubstr("the trajectory is in UTC, the points in GPS time"));
}

TEST_P(TrackCheckOf, PointsInUtcAreNamed) {
  for (const double leap : {16, 17, 18}) {
    const TrackCheck check = Check([&](double t) { return flight_.Position(t - leap); });
    EXPECT_EQ(check.verdict, TrackVerdict::kTimeOffset) << Describe(check);
    EXPECT_NEAR(check.time.value, leap, 0.05);
    EXPECT_THAT(Describe(check), HasSubstr("the points are in UTC"));
  }
}

TEST_P(TrackCheckOf, AMissingGeoidSeparationIsNamed) {
  for (const double separation : {-25.0, 25.0}) {
    const TrackCheck check = Moved(0, 0, separation);
    EXPECT_EQ(check.verdict, TrackVerdict::kHeightOffset) << Describe(check);
    EXPECT_NEAR(check.up.value, -separation, 2);
    // All three scanners look more than 10 degrees from the vertical in the median: sin(10) 25 m / 260 m = 1 degree.
    EXPECT_LT(DegreesOfRadians(check.mean_difference.value) * separation, -0.7 * 25);
  }
}

TEST_P(TrackCheckOf, UtcAndAMissingGeoidSeparationAreBothNamed) {
  const TrackCheck check = Check([&](double t) -> Vector3d { return flight_.Position(t + 18) + Vector3d(0, 0, 25); });
  EXPECT_EQ(check.verdict, TrackVerdict::kTimeOffset) << Describe(check);
  EXPECT_NEAR(check.up_with_time, -25, 2);
}

TEST_P(TrackCheckOf, FeetAreNamed) {
  const auto scaled = [&](double ratio) {
    return Check([&, ratio](double t) {
      Vector3d position = flight_.Position(t);
      position.z() *= ratio;
      return position;
    });
  };
  const TrackCheck feet = scaled(1 / 0.3048), metres = scaled(0.3048);
  EXPECT_EQ(feet.verdict, TrackVerdict::kHeightUnit) << Describe(feet);
  EXPECT_THAT(Describe(feet), HasSubstr("in feet, not in metres"));
  EXPECT_EQ(metres.verdict, TrackVerdict::kHeightUnit) << Describe(metres);
}

TEST_P(TrackCheckOf, AHorizontalLeverArmIsNamed) {
  const TrackCheck forward = Moved(5, 0, 0), right = Moved(0, -5, 0);
  EXPECT_EQ(forward.verdict, TrackVerdict::kHorizontalOffset) << Describe(forward);
  EXPECT_NEAR(forward.forward.value, -5, 0.5);
  EXPECT_NEAR(forward.right.value, 0, 0.5);
  EXPECT_EQ(right.verdict, TrackVerdict::kHorizontalOffset) << Describe(right);
  EXPECT_NEAR(right.right.value, 5, 0.5);
}

// 5 m at 250 m change the incidence of a beam at 20 degrees by 0.37 degrees, at 12 degrees by 0.23 degrees.
TEST_P(TrackCheckOf, AVerticalLeverArmIsNamedWhereItMatters) {
  const TrackCheck check = Moved(0, 0, 5);
  EXPECT_NEAR(check.up.value, -5, 2);
  const double change = 5 / check.range * std::sin(check.median_incidence);
  if (change > RadiansOfDegrees(0.31)) {
    EXPECT_EQ(check.verdict, TrackVerdict::kHeightOffset) << Describe(check);
  }
  if (change < RadiansOfDegrees(0.25)) {
    EXPECT_EQ(check.verdict, TrackVerdict::kAgrees) << Describe(check);
  }
}

TEST_P(TrackCheckOf, AnotherFlightIsNamed) {
  static const SampledFlight crossing({.height = 250, .course = 1.2, .seed = 99});
  static const SampledFlight parallel({.height = 250, .seed = 98});
  for (const auto& check : {Check([&](double t) { return crossing.Position(t); }),
                            Check([&](double t) -> Vector3d { return parallel.Position(t) + Vector3d(300, 0, 0); }),
                            Check([&](double t) -> Vector3d { return flight_.Position(t) + Vector3d(3e4, -2e4, 0); })})
    EXPECT_EQ(check.verdict, TrackVerdict::kUnrelated) << Describe(check);
}

// No offset in time makes a track agree that runs away from the rays by 5 m/s.
TEST_P(TrackCheckOf, AFlightOfAnotherSpeedIsNoTimeOffset) {
  static const SampledFlight faster({.height = 250, .speed = 65, .seed = 97});
  const TrackCheck check = Check([&](double t) { return faster.Position(t); });
  EXPECT_EQ(check.verdict, TrackVerdict::kUnrelated) << Describe(check);
}

TEST_P(TrackCheckOf, ARotationIsNamed) {
  const TrackCheck check = Check([&](double t) {
    const Vector3d at = flight_.Position(t);
    const double angle = RadiansOfDegrees(1.5);
    return Vector3d(std::cos(angle) * at.x() - std::sin(angle) * at.y(),
                    std::sin(angle) * at.x() + std::cos(angle) * at.y(), at.z());
  });
  EXPECT_EQ(check.verdict, TrackVerdict::kRotation) << Describe(check);
  EXPECT_NEAR(DegreesOfRadians(check.rotation.value), -1.5, 0.2);
}

TEST(TrackCheck, NeverRefusesARightTrack) {
  int agreeing = 0;
  const int flights = albtpu::testing::EveryCase() ? 200 : 60;
  for (int i = 0; i < flights; ++i) {
    const SimulatedFlight flight({.scanner = static_cast<ScannerKind>(i % 3),
                                  .height = 200.0 + 4 * ((i * 37) % 100),
                                  .speed = 56 + 0.24 * ((i * 53) % 100),
                                  .course = 1.0 * i,
                                  .duration = 5 + 0.35 * ((i * 29) % 100),
                                  .pairs_per_second = std::pow(10, 0.3 + 0.025 * ((i * 61) % 100)),
                                  .significant_wave_height = (i / 3) % 2 ? 0.3 : 0,
                                  .outliers = 0.075 * (i % 5),
                                  .seed = static_cast<std::uint64_t>(i + 1)});
    const TrackCheck check = CheckTrack(RaysOf(flight.Rays()), Columns([&](double t) { return flight.Position(t); }));
    EXPECT_FALSE(Disagrees(check.verdict)) << i << ": " << Describe(check);
    agreeing += check.verdict == TrackVerdict::kAgrees;
  }
  EXPECT_GT(agreeing, 0.9 * flights);  // Some of those with fewest rays cannot tell.
}

TEST(TrackCheck, SaysWhenItCannotTell) {
  const SimulatedFlight flight({.duration = 10});
  auto rays = RaysOf(flight.Rays());
  const auto unknown = [](std::span<const double>, std::span<Vector3d> positions) {
    for (Vector3d& position : positions) position.setConstant(std::nan(""));
  };
  EXPECT_EQ(CheckTrack(rays, unknown).verdict, TrackVerdict::kTooFewRays);
  rays.resize(20);
  EXPECT_EQ(CheckTrack(rays, Columns([&](double t) { return flight.Position(t); })).verdict, TrackVerdict::kTooFewRays);
  EXPECT_EQ(CheckTrack({}, unknown).verdict, TrackVerdict::kTooFewRays);
}

TEST(TrackCheck, UsesTheRaysThatTheTrackKnows) {
  const SimulatedFlight flight({.duration = 20});
  const auto check = CheckTrack(RaysOf(flight.Rays()), Columns([&](double t) -> Vector3d {
                                  if (t < 1010) return Vector3d::Constant(std::nan(""));
                                  return flight.Position(t);
                                }));
  EXPECT_EQ(check.verdict, TrackVerdict::kAgrees) << Describe(check);
  EXPECT_NEAR(static_cast<double>(check.rays), 5000, 100);
}

}  // namespace
}  // namespace albtpu
