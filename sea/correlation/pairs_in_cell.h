// What pulses at known places of a square cell share.
//
// R + (1 - R) / n is exact for pulses at random places of the cell. Those of a scan lie evenly in it, so that they
// share less; those at the edge of a swath lie in one part of it, and share more. With C_l the variance of the mean
// over a cell of side a / 2^l, the mean covariance of the points of one such cell is C_l, of which those that share a
// quarter of it, one pair in four, have C_(l+1). Those in different quarters therefore have
//     (4 C_l - C_(l+1)) / 3,
// and each pair of pulses has that of the smallest part in which both lie.
//
// A circle counts as the square of its area: the concentric map of Shirley and Chiu (1997),
// doi:10.1080/10867651.1997.10487479, preserves areas, and leaves parts of a square compact.
#pragma once

#include <Eigen/Core>
#include <array>

namespace albtpu {

inline constexpr int kCellLevels = 3;  // The cell, its quarters, and the quarters of these.

// From the circle of radius 1 around the origin to the square of 0 to 1. Points beyond it come to its sides.
Eigen::Vector2d SquareOfCircle(const Eigen::Vector2d& at);

class PairsInCell {
 public:
  // A pulse at x and y, 0 to 1 along the sides of the cell.
  void Add(double x, double y);

  // Of C_l: the sum of the covariances of all pairs of two different pulses, each counted twice, is that of
  // Weights()[l] C_l.
  std::array<double, kCellLevels> Weights() const;

 private:
  static constexpr int kParts = 1 << (kCellLevels - 1);  // Along a side.
  std::array<double, kParts* kParts> counts_ = {};
};

}  // namespace albtpu
