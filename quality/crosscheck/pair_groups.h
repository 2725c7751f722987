// Pairs of points that are close together: what they differ by on average, and how certain their mean is.
//
// Pairs of the same two lines in one place, seen at one time, share waves and the errors of both trajectories. The mean
// of their differences therefore has the variance
//     V_line + noise,    noise = (sum over pairs of V_air + sum over each two pairs of the covariance of waves) / n^2,
// with C(dx, dt) of each line by itself, because two lines see the sea at other times.
#pragma once

#include <compare>
#include <cstddef>
#include <limits>
#include <vector>

#include "quality/crosscheck/overlap_patches.h"

namespace albtpu::quality {

// With an interval: 0 to infinity where the data do not bound it.
struct Estimate {
  double value = 0, low = 0, high = std::numeric_limits<double>::infinity();

  bool excludes(double number) const { return number < low || number > high; }
};

// A square of the survey, by its column and row.
struct Place {
  int column = 0, row = 0;
  auto operator<=>(const Place&) const = default;
};
Place PlaceOf(const CrossPair& pair, double side);

// The pairs of two lines in a square, each seen at one time: a scanner that looks ahead and back sees it twice, seconds
// apart, with other errors of the trajectory.
struct PairGroup {
  std::uint16_t line_a = 0, line_b = 0;
  std::vector<std::size_t> pairs;     // Their numbers.
  std::vector<double> sea_rows = {};  // m^2, for each pair: the covariances of its waves with those of all, itself too.
  std::size_t within = 0;             // Of a cell: the number of its place.
  double mean = 0;                    // m, of the differences.
  // m^2, variances: of the mean, by pulse and sea; the sea's part of that; of all that a pair has anew, the mean.
  double noise = 0, noise_of_sea = 0, of_pair = 0;
  // m^2, means over the pairs: of each line, and of the product of both standard deviations.
  double line_a_variance = 0, line_b_variance = 0, line_product = 0;

  double line_variance() const { return line_a_variance + line_b_variance; }
  auto count() const { return static_cast<double>(pairs.size()); }
};

struct PairGroups {
  double cell = 0;               // m, the side of the cells, within which the errors of a trajectory are constant.
  double place = 0;              // m, of places, which share slopes at their sides alone: kCellsAlongPlace cells.
  std::vector<PairGroup> cells;  // In the order of lines and places.
  std::vector<PairGroup> places;
};

// A cell is 5 patches wide, or so many more that two lines have kPairsOfCell pairs in one.
inline constexpr int kCellsAlongPlace = 4;
inline constexpr double kPairsOfCell = 4;
inline constexpr double kLook = 2;  // s
static_assert(SharedWaves::kPause >= kLook);

// What the sea does to both points of one line, m^2: the covariance of its shares in their heights.
double CovarianceOfSea(const PairedPoint& a, const PairedPoint& b, const SharedWaves& waves);

PairGroups GroupPairs(const std::vector<CrossPair>& across, double patch, const SharedWaves& waves);

}  // namespace albtpu::quality
