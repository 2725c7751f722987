// The statistics of differences at check points, of which some errors are common.
//
// A difference d has three errors: its own (pulses, waves, the check point), those of its lines, which other places
// share, and those of the survey, which all places share (U). W is the covariance of the first two, V of all three:
//
//   mean     The variance without U is 1'W1 / n^2. Where differences scatter about their mean more than W says, by the
//            factor s^2 > 1 of sum (d - mean)^2 to its expectation tr W - 1'W1 / n, the variance is s^2 times that.
//   RMSE     n RMSE^2 has the variance 2 c^2 tr W^2 + 4 c m^2 1'W1, m the offset of the survey, which counts as what it
//            is, and c such that c tr W + n m^2 is what was found. It is nearly a multiple of chi-square with 2 E^2 /
//            var degrees of freedom (Satterthwaite 1946, doi:10.2307/3002019): n of independent points and no offset.
//   z^2      z = (d - predicted bias) / sqrt(V_ii). The sum has the mean n and the variance 2 sum of the squares of
//            all correlations, so that its mean has n^2 / (that sum) degrees of freedom: n of independent points, 1 of
//            points with nothing but common errors.
//
// docs/checkpoints.md says the same in more words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "quality/crosscheck/pair_groups.h"

namespace albtpu::quality {

// At one check point; the surface less the check point.
struct Difference {
  double difference = 0;                                         // m
  double bias = 0;                                               // m, predicted of it
  double own = 0;                                                // m^2, variance of pulses, waves and the check point
  double survey = 0;                                             // m, 1 sigma: what all points share
  std::vector<std::pair<std::uint16_t, double>> lines = {};      // Number; m, 1 sigma. In order, each once.
  std::vector<std::pair<std::size_t, double>> same_points = {};  // A later difference; m^2, covariance of `own`.
  double tvu = 0;                                                // m at 95 %, of the points around
  double point_sigma = 0;                                        // m, 1 sigma: of the check point's elevation

  double variance() const;  // Of all, m^2.
};

struct DifferenceStatistics {
  std::size_t points = 0;
  double lowest = 0, highest = 0;  // m
  Estimate mean = {};              // m; its interval at 95 % is without what all points share.
  double standard_error = 0;       // m, of that
  double bias = 0;                 // m, predicted of the mean
  double deviation = 0;            // m, of the sample; 0 of one point
  double percentile95 = 0;         // m, of |d|, between two of the sample in proportion
  Estimate rmse = {};              // m
  double rmse_degrees = 0;         // Of freedom.
  double rmse_points = 0;          // m, of the check points themselves
  Estimate squared_z = {};         // The mean.
  double squared_z_degrees = 0;
  double within_predicted = 0;  // Fraction with |d - bias| up to 1.96 sigma
  double within_tvu = 0;        // Fraction with |d| up to the TVU of the points around
  Estimate scatter = {};  // Measured over predicted standard deviation about the mean; of one point 0 and no interval.
  bool scatter_differs = false;   // From 1 by kMinDifference, beyond an interval of 1 - 2 kTailOfPart.
  bool has_offset = false;        // The mean lies beyond its interval of 1 - 2 kTailOfOffset about the bias.
  double predicted_by_lines = 0;  // m, 1 sigma: of the mean, and the next
  double predicted_by_survey = 0;

  double rmse_total() const;  // m: of differences and check points, as ASPRS edition 2 adds them.
  double offset() const { return mean.value - bias; }
  // In units of all that is predicted of it.
  double offset_z() const;
};

inline constexpr double kTailOfOffset = 0.005;  // Of surveys without one, one in 100 is said to have an offset.

// Of some of `all`, one at least, in order.
DifferenceStatistics StatisticsOf(const std::vector<Difference>& all, std::span<const std::size_t> taken);

}  // namespace albtpu::quality
