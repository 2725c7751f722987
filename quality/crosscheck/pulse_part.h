// What is drawn anew for each pulse: are its predicted variances, of the air side and of the sea, right?
//
// Two kinds of squared differences tell them apart. Within a cell, pairs of two lines differ from their mean by the air
// side and the sea. Two neighbouring points of one line share most waves and all of the trajectory, and differ by the
// air side and by what C(dx, dt) leaves of the sea.
#pragma once

#include <string>
#include <vector>

#include "quality/crosscheck/overlap_patches.h"
#include "quality/crosscheck/pair_groups.h"
#include "quality/crosscheck/shared_waves.h"

namespace albtpu::quality {

struct SquaredDifference {
  Place place;
  bool across = true;                  // Lines; otherwise of one line.
  double square = 0;                   // m^2
  double air = 0, sea = 0, slope = 0;  // m^2, what is predicted of it: air side, sea, and the error of the slope.
  double distance = 0;                 // m^2, of the two points, squared.
};

std::vector<SquaredDifference> SquaredDifferences(const PatchPairs& pairs, const PairGroups& groups,
                                                  const SharedWaves& waves);

struct PulsePart {
  Estimate factor;       // By which the predicted standard deviations would have to be multiplied; at 95 %.
  Estimate air, sea;     // The same of each.
  bool differs = false;  // `factor` from 1 by kMinDifference, beyond an interval of 1 - kTailOfPart.
  std::string named;     // "air" or "sea": what makes it differ; empty where the two cannot be separated.
  double rough = 0;      // Of the bottom, m^2 in the square of a metre of distance; 0 where it is not significant.
  std::size_t places = 0;
};

inline constexpr double kMinDifference = 0.1;  // No decision depends on a tenth of a standard deviation.
// Two parts are tested, on two sides: of surveys in which nothing is wrong, a part is said to differ in one of 100.
inline constexpr double kTailOfPart = 0.01 / 4;

// Fits E[q] = k_air^2 V_air + k_sea^2 V_sea + V_slope + rough h^2, with the distance h of the two points, by weighted
// least squares without negative terms; then E[q] = k^2 (V_air + V_sea) + V_slope + rough h^2 to those across lines.
// `guess` is one of k.
//
// Samples of one place share waves and bottom. Intervals are therefore by jackknife (Efron and Tibshirani 1993, chapter
// 11) on the scale of k: each place is left out in turn. Where the part differs, it is of the air side or of the sea if
// only that one's interval, with the same tail, lies on that side of 1: waves that are not those of the prediction
// share more or less than C says, which makes the other one err to the other side.
PulsePart FitPulses(const std::vector<SquaredDifference>& samples, double guess);

}  // namespace albtpu::quality
