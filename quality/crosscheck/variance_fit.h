// The dependence of the squared differences of neighbouring points on their predicted variances.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "quality/crosscheck/overlap_patches.h"

namespace albtpu::quality {

// With an interval: 0 to infinity where the data do not bound it.
struct Estimate {
  double value = 0, low = 0, high = 0;

  bool excludes(double number) const { return number < low || number > high; }
};

// A place of a survey, kPlace by kPlace m, with all pairs of lines in it.
inline constexpr double kPlace = 750;
using Place = std::pair<int, int>;
Place PlaceOf(const CrossPair& pair);

// The predicted variance with that of a bottom whose height departs from its plane by `rough` m^2 in the square of a
// metre of distance.
double PredictedVariance(const CrossPair& pair, double rough);

struct VarianceFit {
  Estimate factor;    // By which the predicted standard deviations would have to be multiplied; at 95 %.
  Estimate air, sea;  // The same for air side and sea.
  bool air_differs = false, sea_differs = false;  // From 1, beyond intervals of 99 %.
  double rough = 0;                               // As above; 0 where it is not significant.
  std::string units;                              // "lines" or "places": what was left out in turn for the intervals.
};

// Fits E[d^2] = k_air^2 V_air + k_sea^2 V_sea + V_slope + rough h^2, with the distance h of the two points, by weighted
// least squares without negative terms; then E[d^2] = k^2 (V_air + V_sea) + V_slope + rough h^2. `pairs` is not empty;
// `factor` is a guess of k.
//
// Differences are not independent: all those of a line share the errors of its trajectory, and neighbours share waves.
// Intervals are therefore by jackknife (Efron and Tibshirani 1993, chapter 11) on the scale of k: each line is left out
// in turn with all its pairs. Student's t has one degree of freedom less than there are lines. A pair is left out with
// each of its two lines, which is on the safe side. Fewer than kMinLines lines do not give an interval; then places
// are left out in turn.
inline constexpr std::size_t kMinLines = 5;
VarianceFit FitVariance(const std::vector<CrossPair>& pairs, double factor);

}  // namespace albtpu::quality
