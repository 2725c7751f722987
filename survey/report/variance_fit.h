// How the squared differences of neighbouring points depend on what is predicted of them.
#pragma once

#include <utility>
#include <vector>

#include "survey/report/cross_pairs.h"

namespace albtpu::client {

// With a 95 % interval, or a wider one.
struct Estimate {
  double value = 0, low = 0, high = 0;

  bool excludes(double number) const { return number < low || number > high; }
};

// A place of a survey, kPlace by kPlace m, with all pairs of lines in it, because two of them may have one line in
// common. Differences in one place are not independent: neighbours share waves and the errors of the trajectory.
inline constexpr double kPlace = 500;
using Place = std::pair<int, int>;
Place PlaceOf(const CrossPair& pair);

// The predicted variance with that of a bottom whose height departs from its plane by `rough` m^2 in the square of a
// metre of distance.
double PredictedVariance(const CrossPair& pair, double rough);

struct VarianceFit {
  Estimate factor;          // By which the predicted standard deviations would have to be multiplied.
  Estimate air, sea;        // The same of shares.
  Estimate air_99, sea_99;  // With intervals of 99.5 %.
  double rough = 0;         // As above; 0 where it is not significant.
};

// Fits E[d^2] = k_air^2 V_air + k_sea^2 V_sea + V_slope + rough h^2, with the distance h of the two points, by weighted
// least squares without negative terms; then E[d^2] = k^2 (V_air + V_sea) + V_slope + rough h^2. Intervals are by
// bootstrap over places (Efron and Tibshirani 1993, chapter 8), with a fixed seed. `pairs` is not empty; `factor` is a
// guess of k.
VarianceFit FitVariance(const std::vector<CrossPair>& pairs, double factor);

}  // namespace albtpu::client
