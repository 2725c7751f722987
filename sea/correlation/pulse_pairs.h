// What the pulses of one pass share at their places: the sum of their covariances over all pairs.
//
// R + (1 - R) / n is exact for pulses at random places of a cell. Those of a scan keep their distance from each other,
// so that they share less; those at the edge of a swath lie in one part of the cell, and share more. The covariance by
// lag knows both. For a beam over a sea it is held on a lattice of distances: at each as even harmonics of the
// direction, for at one instant it is the same for the opposite lag, and between these by cubics. All this is linear:
// one vector of weights stands for all pairs, whatever the beam.
#pragma once

#include <Eigen/Core>
#include <span>

#include "sea/correlation/pulse_correlation.h"

namespace albtpu {

class PulsePairs {
 public:
  // In cells whose diagonal [m] is longer than kWhole, pairs further apart than kReach have one covariance, the mean of
  // those that are so far apart in a cell. It is what the near ones leave of all, so that it is known well only where
  // the far ones are many.
  static constexpr double kWhole = 16, kReach = 8;
  // Of more pulses, pairs are those of some, spread over all, with the others.
  static constexpr std::size_t kMostPulses = 32;
  // xx, xy, xz, yy, yz and zz of the errors per depth^2, on the axes of the sea, and the heights.
  static constexpr int kEntries = 7;

  // Of pulses in square cells of a side, m, or in circles of their area.
  explicit PulsePairs(double side);

  // The weights of ordered pairs, each of two different pulses. Places in m, on axes that lie `orientation` [rad] to
  // the left of those of the sea that the table is of.
  Eigen::VectorXf WeightsOf(std::span<const Eigen::Vector2d> places) const;

  // Of the covariances of one beam; the sum over pairs is its transpose times their weights. The first row is a pulse.
  Eigen::MatrixXf TableOf(const BeamCorrelation& beam, double orientation) const;

 private:
  static constexpr int kHarmonics = 7;  // 1, and the cosine and the sine of 2, 4 and 6 times the direction.

  double Distance(int j) const;
  void Add(const Eigen::Vector2d& lag, double weight, Eigen::VectorXd& weights) const;

  double side_;
  double reach_;  // m
  int distances_;
  Eigen::VectorXd near_;  // Of two random points of a cell within reach of each other.
  double far_ = 0;        // How many of these pairs are further apart.
};

}  // namespace albtpu
