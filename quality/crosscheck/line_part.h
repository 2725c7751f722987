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

// Of the 0.5 % of a part (kTailOfPart on each side), most is for errors that are larger than stated: these mislead who
// relies on an uncertainty, and few lines show them.
inline constexpr double kTailOfLarger = 0.004, kTailOfSmaller = 0.001;

struct LinePart {
  // By which the predicted standard deviations of lines would have to be multiplied, at 95 %; absent where none is
  // predicted.
  std::optional<Estimate> factor;
  bool differs = false;  // From 1 by kMinDifference, beyond an interval of 1 - kTailOfLarger - kTailOfSmaller.
  double degrees = 0;    // Of freedom, at that factor: as many lines could differ independently.
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
// With the covariances C of all means, and W of their weights, the traces t_n of (W C)^n tell how Q is distributed
// where errors are normal: t_1 = E(k), 2 t_2 is the variance, 8 t_3 the third cumulant. (Q - t_1) t_2 / t_3 is nearly
// chi-square less its mean, of t_2^3 / t_3^2 degrees of freedom (Pearson's approximation by three moments, in Imhof
// 1961, doi:10.1093/biomet/48.3-4.419). What lines have in Q is taken as a multiple of chi-square: t_1^2 / t_2 degrees,
// t_3 = t_2^2 / t_1. An end of the interval is the factor k at which the Q that was found is in a tail.
//
// The squared correlation of the errors of one line at two places is in t_2 = sum of w w' cov(m, m')^2. Many places
// show what changes between those of two lines, u^2 V_line, which is taken as known whatever k is: of k^2 V_line the
// rest lasts, and c = 1 - u^2 / k^2 is the mean correlation. Where an error has a constant part and one whose
// correlation falls exponentially (Gauss-Markov), the mean square of the correlation is at most c (1 + c) / 2, which is
// taken. It is exact of errors that last for whole lines, and of those that do not last at all.
LinePart TestLines(const PairGroups& groups);

}  // namespace albtpu::quality
