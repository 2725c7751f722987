// What a line shares: do whole lines differ by as much as their trajectories are said to err?
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "quality/crosscheck/overlap_patches.h"
#include "quality/crosscheck/pair_groups.h"

namespace albtpu::quality {

// The height difference between two lines.
struct LineDifference {
  int line_a = 0, line_b = 0;                                                    // Point source IDs.
  double begin_a = std::numeric_limits<double>::quiet_NaN(), begin_b = begin_a;  // As FlightLine::begin.
  std::size_t pairs = 0;
  double mean = 0;            // m, line a less line b.
  double standard_error = 0;  // m, of that mean, by pulses, sea and bottom.
  double predicted = 0;       // m, the standard deviation of the difference that both trajectories are said to have.

  // In units of all that is predicted.
  double z() const { return mean / std::hypot(standard_error, predicted); }
};

struct LinePart {
  // By which the predicted standard deviations of lines would have to be multiplied, at 95 %; absent where none is
  // predicted.
  std::optional<Estimate> factor;
  bool differs = false;  // From 1 by kMinDifference, beyond an interval of 1 - 2 kTailOfPart.
  double degrees = 0;    // Of freedom: as many lines could differ independently.
  double lasting = 1;    // The correlation of a line's error between two places of an overlap, 0 to 1.
  double noise = 1;      // The standard deviation of means of cells over the predicted one, at least 1.
  std::vector<LineDifference> differences;  // The largest first.
};

// With the means m of the pairs of two lines in a place, Q = sum of w m^2 has the mean
//     E(k) = k^2 sum of w V_line + f^2 sum of w noise
// whatever part of its length an error of a trajectory lasts: nothing is taken as constant in a line. f^2 is measured:
// by how much more the means of cells scatter within places than predicted, because the bottom is rough, or because
// pulses err more. It is not taken as less than 1. The weights are the best ones of independent places, divided by the
// number of places of the two lines.
//
// Of normal errors Q is nearly a multiple of chi-square, with the degrees of freedom 2 E^2 / var(Q) (Satterthwaite
// 1946, doi:10.2307/3002019), and an end of the interval is the factor k at which the Q that was found is in a tail.
// var(Q) = 2 sum of w w' cov(m, m')^2, in which the errors of one line at two places have the mean squared correlation
// `lasting`: that correlation itself, as the products of means of the same two lines show it. Its square is smaller,
// so that this is on the safe side, and it is exact of errors that last for whole lines and of those that do not last.
LinePart TestLines(const PairGroups& groups);

}  // namespace albtpu::quality
