#include "sea/correlation/pulse_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sea/catmull_rom.h"

namespace albtpu {
namespace {

// Distances are kFirst sinh(kStep j): even near 0, where footprints overlap, and further apart where waves are long.
constexpr double kFirst = 0.4, kStep = 0.25;  // m, 1

using Entries = Eigen::Matrix<double, 1, PulsePairs::kEntries>;

Entries EntriesOf(const SharedWaves& shared) {
  const Eigen::Matrix3d errors = shared.errors();
  return {errors(0, 0), errors(0, 1), errors(0, 2), errors(1, 1), errors(1, 2), errors(2, 2), shared.footprint.heights};
}

}  // namespace

PulsePairs::PulsePairs(double side) : side_(side) {
  const double diagonal = std::numbers::sqrt2 * side;
  const bool whole = diagonal <= kWhole;
  reach_ = whole ? std::numeric_limits<double>::infinity() : kReach;
  // The cubic needs one more.
  distances_ = static_cast<int>(std::asinh((whole ? diagonal : kReach) / kFirst) / kStep) + 3;
  near_ = Eigen::VectorXd::Zero(kHarmonics * distances_ + 1);
  if (whole) return;
  constexpr int kSteps = 200;  // Along half of each axis, of the density of the lag.
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) / kSteps, y = (j + 0.5) / kSteps, weight = 2 * (1 - x) * (1 - y) / (kSteps * kSteps);
      for (const double sign : {1.0, -1.0}) Add({side * x, sign * side * y}, weight, near_);
    }
  far_ = near_(near_.size() - 1);
  near_(near_.size() - 1) = 0;
}

double PulsePairs::Distance(int j) const { return kFirst * std::sinh(kStep * j); }

void PulsePairs::Add(const Eigen::Vector2d& lag, double weight, Eigen::VectorXd& weights) const {
  const double distance = lag.norm();
  if (distance > reach_) {
    weights(weights.size() - 1) += weight;
    return;
  }
  const double first = distance / kFirst, step = std::log(first + std::sqrt(1 + first * first)) / kStep;  // asinh
  const int j = std::min(static_cast<int>(step), distances_ - 3);
  const double t = step - j;
  const std::array<double, 4> shares = CatmullRomWeights(t);  // On the other side of 0 are the same values.
  const double squared = std::max(distance * distance, 1e-18);
  const double cosine2 = (lag.x() * lag.x() - lag.y() * lag.y()) / squared, sine2 = 2 * lag.x() * lag.y() / squared;
  const double cosine4 = cosine2 * cosine2 - sine2 * sine2, sine4 = 2 * sine2 * cosine2;
  const Eigen::Matrix<double, kHarmonics, 1> harmonics(
      {1, cosine2, sine2, cosine4, sine4, cosine4 * cosine2 - sine4 * sine2, sine4 * cosine2 + cosine4 * sine2});
  for (int n = 0; n < 4; ++n)
    weights.segment<kHarmonics>(kHarmonics * std::abs(j + n - 1)) +=
        weight * shares[static_cast<std::size_t>(n)] * harmonics;
}

Eigen::VectorXf PulsePairs::WeightsOf(std::span<const Eigen::Vector2d> places) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(near_.size());
  const std::size_t n = places.size(), some = std::min(n, kMostPulses);
  for (std::size_t k = 0; k < some; ++k) {
    // In the order of a scan, golden sections meet no line of it again and again at the same place.
    const double section = std::fmod(static_cast<double>(k) * std::numbers::phi, 1);
    const std::size_t i = some == n ? k : static_cast<std::size_t>(section * static_cast<double>(n));
    const double weight = static_cast<double>(n) / static_cast<double>(some);
    if (some < n) {
      for (std::size_t j = 0; j < n; ++j)
        if (j != i) Add(places[j] - places[i], weight, weights);
    } else {
      for (std::size_t j = 0; j < i; ++j) Add(places[j] - places[i], 2, weights);
    }
  }
  return weights.cast<float>();
}

Eigen::MatrixXf PulsePairs::TableOf(const BeamCorrelation& beam, double orientation) const {
  constexpr int kDirections = 8;  // Of half a turn.
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(near_.size(), kEntries);
  table.row(0) = EntriesOf(beam.pulse());
  for (int j = 1; j < distances_; ++j) {
    const WavesAtDistance waves = beam.waves().AtDistance(Distance(j), 0);
    for (int d = 0; d < kDirections; ++d) {
      const double direction = std::numbers::pi * d / kDirections;
      const Entries entries = EntriesOf(beam.SharedNearly(waves.Towards(direction + orientation))) / kDirections;
      table.row(kHarmonics * j) += entries;
      for (int m = 1; 2 * m < kHarmonics; ++m) {
        table.row(kHarmonics * j + 2 * m - 1) += 2 * std::cos(2 * m * direction) * entries;
        table.row(kHarmonics * j + 2 * m) += 2 * std::sin(2 * m * direction) * entries;
      }
    }
  }
  if (far_ > 0) {
    const Entries all = EntriesOf(beam.InCell({.side = side_, .orientation = orientation}));
    table.row(table.rows() - 1) = (all - near_.transpose() * table) / far_;
  }
  return table.cast<float>();
}

}  // namespace albtpu
