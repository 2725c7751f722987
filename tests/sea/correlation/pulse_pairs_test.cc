#include "sea/correlation/pulse_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sea/spectra/described_sea.h"

namespace albtpu {
namespace {

using Eigen::Vector2d;

class PulsePairsOf : public testing::Test {
 protected:
  PulsePairsOf() : sea_(Describe({.wind_speed_10m = 6, .wind_from = 0}).spectrum) {}

  BeamCorrelation Beam(double incidence) const {
    return {sea_, {.incidence = incidence, .azimuth = 0.4, .footprint = 0.6}, 1.34};
  }
  // Of vertical errors: the sum over ordered pairs, over the variance of one pulse. Axes of places lie 0.7 to the left.
  static double Sum(const PulsePairs& pairs, const Eigen::MatrixXf& table, const std::vector<Vector2d>& places) {
    return table.col(5).dot(pairs.WeightsOf(places)) / table(0, 5);
  }
  static double SumOfEach(const BeamCorrelation& beam, const std::vector<Vector2d>& places) {
    double sum = 0;
    const Eigen::Rotation2Dd turn(kOrientation);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        sum += 2 * beam.Between(turn * (places[i] - places[j]), 0).errors()(2, 2) / beam.pulse().errors()(2, 2);
    return sum;
  }
  static std::vector<Vector2d> Scan(double side, double spacing, std::mt19937_64& random) {
    std::uniform_real_distribution<double> within(0, spacing);
    const double first_x = within(random), first_y = within(random);
    std::vector<Vector2d> places;
    for (double x = first_x; x < side; x += spacing)
      for (double y = first_y; y < side; y += spacing) places.emplace_back(x, y);
    return places;
  }

  static constexpr double kOrientation = 0.7;
  WaveCorrelation sea_;
};

// To take pulses of a scan for those at random places is wrong by more than twice as much.
TEST_F(PulsePairsOf, AScanAreThoseOfAllItsPairs) {
  std::mt19937_64 random(2);
  for (const double incidence : {0.0, 0.05, 0.35}) {
    const BeamCorrelation beam = Beam(incidence);
    for (const double side : {0.5, 2.0, 4.0}) {
      const PulsePairs pairs(side);
      const Eigen::MatrixXf table = pairs.TableOf(beam, kOrientation);
      const std::vector<Vector2d> places = Scan(side, side > 2 ? 0.8 : 0.25 * side, random);
      const auto n = static_cast<double>(places.size());
      const double exact = n + SumOfEach(beam, places);
      // At nadir errors are of second order, whose correlation is nearly that of the table.
      EXPECT_NEAR((n + Sum(pairs, table, places)) / exact, 1, incidence == 0 ? 0.03 : 0.01)
          << incidence << ", " << side << " m";
      const double anywhere =
          n + n * (n - 1) * beam.InCell({.side = side, .orientation = kOrientation}).errors()(2, 2) / table(0, 5);
      EXPECT_TRUE(side < 1 || anywhere / exact > 1.02) << incidence << ", " << side << " m, " << anywhere / exact;
    }
  }
}

TEST_F(PulsePairsOf, EachDirectionHaveTheirOwnCovariance) {
  const BeamCorrelation beam = Beam(0.35);
  const PulsePairs pairs(5);
  const Eigen::MatrixXf table = pairs.TableOf(beam, kOrientation);
  for (const double distance : {0.05, 0.3, 1.0, 3.0, 6.0})
    for (int d = 0; d < 8; ++d) {
      const std::vector<Vector2d> places = {Vector2d(1, 1),
                                            Vector2d(1, 1) + distance * Vector2d(std::cos(d), std::sin(d))};
      EXPECT_NEAR(Sum(pairs, table, places), SumOfEach(beam, places), 0.02) << distance << " m, " << d;
    }
}

// Cells within reach of all their pulses and beyond it, with all pairs and with those of some pulses.
TEST_F(PulsePairsOf, RandomPlacesAreThoseOfTheCellInTheMean) {
  std::mt19937_64 random(1);
  const BeamCorrelation beam = Beam(0.35);
  for (const double side : {1.0, 4.0, 12.0})
    for (const int pulses : {20, 200}) {
      const PulsePairs pairs(side);
      const Eigen::MatrixXf table = pairs.TableOf(beam, kOrientation);
      std::uniform_real_distribution<double> within(0, side);
      constexpr int kDraws = 500;
      double sum = 0, squares = 0;
      for (int draw = 0; draw < kDraws; ++draw) {
        std::vector<Vector2d> places(static_cast<std::size_t>(pulses));
        for (Vector2d& place : places) place.x() = within(random), place.y() = within(random);
        const double mean = Sum(pairs, table, places) / (pulses * (pulses - 1));
        sum += mean / kDraws, squares += mean * mean / kDraws;
      }
      const double of_cell = beam.InCell({.side = side, .orientation = kOrientation}).errors()(2, 2) / table(0, 5);
      EXPECT_NEAR(sum, of_cell, 0.005 + 4 * std::sqrt((squares - sum * sum) / kDraws)) << side << " m, " << pulses;
    }
}

// The furthest pairs of a cell: sparse nodes have points in opposite corners. In cells of more than 11.3 m, all pairs
// that are further than 8 m apart have their mean.
TEST_F(PulsePairsOf, CornersAreThoseOfTheirPairs) {
  for (const double incidence : {0.0, 0.35}) {
    const BeamCorrelation beam = Beam(incidence);
    for (const double side : {5.0, 5.66, 5.7, 5.8, 6.0, 6.096, 7.0, 8.0, 10.0, 11.3, 11.4, 14.0, 20.0}) {
      const PulsePairs pairs(side);
      const Eigen::MatrixXf table = pairs.TableOf(beam, kOrientation);
      const double c = 0.495 * side;
      const std::vector<Vector2d> places = {{-c, -c}, {c, -c}, {-c, c}, {c, c}};
      EXPECT_NEAR((4 + Sum(pairs, table, places)) / 16, (4 + SumOfEach(beam, places)) / 16, side < 11.3 ? 0.01 : 0.02)
          << incidence << ", " << side << " m";
    }
  }
}

// Rasters of 600 to 1200 pulses, whose pairs are told from those of 32.
TEST_F(PulsePairsOf, ManyPulsesAreToldFromSome) {
  std::mt19937_64 random(3);
  const BeamCorrelation beam = Beam(0.35);
  const PulsePairs pairs(4);
  const Eigen::MatrixXf table = pairs.TableOf(beam, kOrientation);
  const double of_cell = beam.InCell({.side = 4, .orientation = kOrientation}).errors()(2, 2) / table(0, 5);
  constexpr int kScans = 50;
  double mean = 0;
  for (int scan = 0; scan < kScans; ++scan) {
    const std::vector<Vector2d> places = Scan(4, 4 / (25 + 0.2 * scan), random);
    ASSERT_GT(places.size(), 10 * PulsePairs::kMostPulses);
    const auto n = static_cast<double>(places.size());
    const double ratio = (n + Sum(pairs, table, places)) / (n * n) / of_cell;
    EXPECT_NEAR(ratio, 1, 0.05) << n;
    mean += ratio / kScans;
  }
  EXPECT_NEAR(mean, 1, 0.01);
}

TEST_F(PulsePairsOf, OnePulseAreNone) {
  const PulsePairs pairs(2);
  EXPECT_EQ(pairs.WeightsOf(std::vector{Vector2d(0.3, 0.2)}).norm(), 0);
}

}  // namespace
}  // namespace albtpu
