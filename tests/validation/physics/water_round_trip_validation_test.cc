// Pairs of photons, one of them backwards from the receiver, against photons that make the whole way.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "generator/water/water_column.h"
#include "sea/angle.h"
#include "tests/every_case.h"
#include "validation/studies/water_round_trip.h"

namespace albtpu {
namespace {

const PhaseFunction kOcean = PhaseFunction::FournierForand(0.0183);
constexpr std::uint32_t kPools = 16, kPhotons = 250'000;  // some seconds a bottom
constexpr double kSlope = 0.12;                           // of tilted bottoms

struct RoundTripCase {
  std::string name;
  double incidence, attenuation, depth, field_of_view, nanoseconds, footprint;
  bool always = false;

  friend std::ostream& operator<<(std::ostream& out, const RoundTripCase& c) { return out << c.name; }

  RoundTrip Trip(double slope = 0) const {
    // Albedo 0.8; the attenuation is that of diffuse light by Kirk's factor of 0.256.
    const double absorption = attenuation / std::sqrt(1 + 0.256 * 4);
    return {.incidence = RadiansOfDegrees(incidence),
            .scattering = 4 * absorption,
            .absorption = absorption,
            .depth = depth,
            .slope = slope,
            .field_of_view = field_of_view,
            .footprint = footprint};
  }
  WaterColumn Column() const {
    const RoundTrip trip = Trip();
    return {.incidence = trip.incidence,
            .refractive_index = trip.refractive_index,
            .group_index = trip.group_index,
            .scattering = trip.scattering * depth,
            .absorption = trip.absorption / trip.scattering,
            .field_of_view = field_of_view / depth,
            .footprint = footprint / depth};
  }
  double PulseLength() const { return 0.299792458 * nanoseconds / (2 * Column().group_index * depth); }
  EchoSetup Setup(double tilt = 0) const {
    const WaterColumn column = Column();
    return {.incidence = column.incidence,
            .refracted = RefractedAngle(column.incidence, column.refractive_index),
            .group_index = column.group_index,
            .absorption = column.absorption,
            .footprint = column.footprint,
            .field_of_view = column.field_of_view,
            .tilt = tilt,
            .step = PulseLength() / 30,
            .pairs_per_photon = 5};
  }
};

std::vector<Echo> TripsOf(const RoundTripCase& c, double slope, std::uint64_t seed) {
  return TraceRoundTrips(kOcean, c.Trip(slope), c.PulseLength() / 30, kPools, kPhotons, seed);
}

// As ComputeWaterColumn, with a receiver that accepts the same cone; over a level bottom, and over those that fall and
// rise ahead.
std::array<std::vector<Echo>, 3> PairsOf(const RoundTripCase& c) {
  const double depths[] = {c.Column().scattering};
  const EchoSetup setup = c.Setup();
  std::array<std::vector<Echo>, 3> pools;
  for (std::uint32_t pool = 0; pool < 8; ++pool) {
    const WalkSetup beam{.refracted = setup.refracted, .longest_excess = 14 / setup.absorption};
    WalkSetup receiver = beam;
    receiver.cone = c.Trip().cone;
    const auto sources = WalkPhotons(kOcean, beam, depths, 200'000, 1, 0, pool);
    const auto receivers = WalkPhotons(kOcean, receiver, depths, 200'000, 1, 1, pool);
    for (std::size_t i = 0; i < pools.size(); ++i) {
      const double tilts[] = {0, kSlope, -kSlope};
      pools[i].push_back(PairPhotons(sources[0], receivers[0], c.Setup(tilts[i]), 1, 0, pool));
    }
  }
  return pools;
}

WaterColumnBias BiasOf(const RoundTripCase& c, const std::vector<Echo>& echoes) {
  const double pulses[] = {c.PulseLength()};
  return BiasOfEchoes(echoes, c.Column(), pulses);
}

// Where on a tilted plane a detector finds the depth, ahead of where unscattered light meets it: from two bottoms.
Estimate AheadOf(const WaterColumnBias& falls, const WaterColumnBias& rises, Detector detector) {
  const Estimate &below = falls.by_pulse[0].value().vertical[Index(detector)],
                 &above = rises.by_pulse[0].value().vertical[Index(detector)];
  return {(above.value - below.value) / (2 * kSlope),
          std::hypot(above.standard_error, below.standard_error) / (2 * kSlope)};
}

class WaterRoundTrip : public ::testing::TestWithParam<RoundTripCase> {};

TEST_P(WaterRoundTrip, IsWhatPairsOfPhotonsSay) {
  const RoundTripCase& c = GetParam();
  // What is compared is two simulations, so that one case notices a change of either.
  if (!c.always && !albtpu::testing::EveryCase()) GTEST_SKIP() << "ALBTPU_EVERY_CASE=1 runs it";
  const auto [level, falling, rising] = PairsOf(c);
  const WaterColumnBias trips = BiasOf(c, TripsOf(c, 0, 1)), pairs = BiasOf(c, level);
  // Lengths are in units of the depth; `allowed` is in metres.
  const auto agree = [&](const std::string& name, const Estimate& trip, const Estimate& pair, double allowed,
                         double unit) {
    const double error = std::hypot(trip.standard_error, pair.standard_error);
    std::printf("%-14s %-9s %9.5f +- %.5f by trips, %9.5f +- %.5f by pairs\n", c.name.c_str(), name.c_str(),
                trip.value * unit, trip.standard_error * unit, pair.value * unit, pair.standard_error * unit);
    EXPECT_NEAR(trip.value, pair.value, std::max(allowed / unit, 3 * error)) << name;
  };
  ASSERT_TRUE(trips.by_pulse[0] && pairs.by_pulse[0]);
  const WaterColumnBias trips_fall = BiasOf(c, TripsOf(c, kSlope, 2)), trips_rise = BiasOf(c, TripsOf(c, -kSlope, 3));
  const WaterColumnBias pairs_fall = BiasOf(c, falling), pairs_rise = BiasOf(c, rising);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    const std::string name(kDetectorNames[d]);
    agree(name, trips.by_pulse[0]->vertical[d], pairs.by_pulse[0]->vertical[d], 0.001, c.depth);
    agree(name + " x", AheadOf(trips_fall, trips_rise, detector), AheadOf(pairs_fall, pairs_rise, detector), 0.01,
          c.depth);
  }
  agree("spot", trips.spot, pairs.spot, 0, c.depth);
  agree("energy", trips.energy, pairs.energy, 0, 1);
}

INSTANTIATE_TEST_SUITE_P(Cases, WaterRoundTrip,
                         ::testing::Values(RoundTripCase{"wide at 12", 12, 0.1, 10, 16, 5, 2},
                                           RoundTripCase{"wide at 20", 20, 0.1, 10, 16, 5, 2},
                                           RoundTripCase{"turbid at 12", 12, 0.2, 10, 16, 5, 2},
                                           RoundTripCase{"short at 20", 20, 0.1, 10, 3, 1.5, 0.5},
                                           RoundTripCase{"narrow at 12", 12, 0.1, 10, 6, 3, 1, true}),
                         [](const auto& case_info) {
                           std::string name = case_info.param.name;
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace albtpu
