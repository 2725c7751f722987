#include "quality/checkpoints/difference_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quality/crosscheck/pulse_part.h"
#include "sea/samples.h"
#include "tables/coverage.h"

namespace albtpu::quality {
namespace {

constexpr double kNormal95 = 2 * kFactor95;
constexpr double kNormal99 = 2.5758293035489004;  // The 99.5 % quantile, of kTailOfOffset.

double OfLines(const Difference& a, const Difference& b) {
  double sum = 0;
  for (auto i = a.lines.begin(), j = b.lines.begin(); i != a.lines.end() && j != b.lines.end();) {
    if (i->first == j->first) sum += i->second * j->second;
    const bool a_first = i->first <= j->first, b_first = j->first <= i->first;
    if (a_first) ++i;
    if (b_first) ++j;
  }
  return sum;
}

// Sums over the matrices W, without what all share, and R, the correlations of V.
struct CovarianceSums {
  double trace = 0, sum = 0, squares = 0, squared_rows = 0;  // Of W.
  double of_lines = 0;                                       // The lines' part of `sum`.
  double correlations = 0;                                   // Squares of all of R.

  CovarianceSums(const std::vector<Difference>& all, std::span<const std::size_t> taken) {
    std::vector<double> rows(taken.size()), deviations(taken.size());
    for (std::size_t i = 0; i < taken.size(); ++i) deviations[i] = std::sqrt(all[taken[i]].variance());
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const Difference& a = all[taken[i]];
      for (std::size_t j = i; j < taken.size(); ++j) {
        const Difference& b = all[taken[j]];
        const double lines = OfLines(a, b);
        double own = i == j ? a.own : 0;
        if (i != j)
          for (const auto& [other, covariance] : a.same_points)
            if (other == taken[j]) own += covariance;
        const double w = own + lines, times = i == j ? 1 : 2;
        sum += times * w, squares += times * w * w, of_lines += times * lines;
        rows[i] += w;
        if (i != j) rows[j] += w;
        if (i == j) trace += w;
        const double scale = deviations[i] * deviations[j];
        const double r = i == j ? 1 : scale > 0 ? (w + a.survey * b.survey) / scale : 0;
        correlations += times * r * r;
      }
    }
    for (const double row : rows) squared_rows += row * row;
  }
};

double ChiSquareQuantile(double below, double degrees) {
  double low = 0, high = degrees + 10;
  while (ChiSquareBelow(high, degrees) < below) high *= 2;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (ChiSquareBelow(middle, degrees) < below ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Of a mean square that is a multiple of chi-square.
Estimate WithInterval(double mean_square, double degrees, double tail) {
  if (!(degrees > 0) || !std::isfinite(degrees)) return {.value = mean_square};
  const double least = ChiSquareQuantile(tail, degrees);
  return {.value = mean_square,
          .low = mean_square * degrees / ChiSquareQuantile(1 - tail, degrees),
          .high = least > 0 ? mean_square * degrees / least : std::numeric_limits<double>::infinity()};
}

Estimate Root(const Estimate& square) {
  return {.value = std::sqrt(square.value), .low = std::sqrt(square.low), .high = std::sqrt(square.high)};
}

// Of sizes, between two in proportion: of n the k-th smallest is at (k - 1) / (n - 1).
double PercentileOf(std::vector<double> sizes, double fraction) {
  std::ranges::sort(sizes);
  const double at = fraction * static_cast<double>(sizes.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= sizes.size()) return sizes.back();
  return sizes[below] + (at - static_cast<double>(below)) * (sizes[below + 1] - sizes[below]);
}

}  // namespace

double Difference::variance() const { return own + OfLines(*this, *this) + survey * survey; }

double DifferenceStatistics::rmse_total() const { return std::hypot(rmse.value, rmse_points); }

double DifferenceStatistics::offset_z() const { return offset() / std::hypot(standard_error, predicted_by_survey); }

DifferenceStatistics StatisticsOf(const std::vector<Difference>& all, std::span<const std::size_t> taken) {
  DifferenceStatistics of{.points = taken.size(),
                          .lowest = std::numeric_limits<double>::infinity(),
                          .highest = -std::numeric_limits<double>::infinity()};
  const auto n = static_cast<double>(taken.size());
  std::vector<double> sizes;
  double squares = 0, squares_of_points = 0, squared_z = 0;
  for (const std::size_t i : taken) {
    const Difference& d = all[i];
    const double less_bias = d.difference - d.bias, variance = d.variance();
    of.lowest = std::min(of.lowest, d.difference), of.highest = std::max(of.highest, d.difference);
    of.mean.value += d.difference / n, of.bias += d.bias / n, of.predicted_by_survey += d.survey / n;
    squares += d.difference * d.difference, squares_of_points += d.point_sigma * d.point_sigma;
    squared_z += less_bias * less_bias / variance;
    of.within_predicted += std::abs(less_bias) <= kNormal95 * std::sqrt(variance) ? 1 : 0;
    of.within_tvu += std::abs(d.difference) <= d.tvu ? 1 : 0;
    sizes.push_back(std::abs(d.difference));
  }
  of.within_predicted /= n, of.within_tvu /= n;
  of.percentile95 = PercentileOf(std::move(sizes), 0.95);
  of.rmse_points = std::sqrt(squares_of_points / n);
  double about_mean = 0, about_bias = 0;
  for (const std::size_t i : taken) {
    about_mean += std::pow(all[i].difference - of.mean.value, 2);
    about_bias += std::pow(all[i].difference - all[i].bias - of.offset(), 2);
  }
  if (taken.size() > 1) of.deviation = std::sqrt(about_mean / (n - 1));

  const CovarianceSums w(all, taken);
  of.predicted_by_lines = std::sqrt(w.of_lines) / n;
  double more = 1, degrees = 0;
  const double expected = w.trace - w.sum / n;
  if (taken.size() > 1 && expected > 0) {
    degrees = 2 * expected * expected / (2 * (w.squares - 2 * w.squared_rows / n + w.sum * w.sum / (n * n)));
    const double ratio = about_bias / expected;
    of.scatter = Root(WithInterval(ratio, degrees, 0.025));
    of.scatter_differs =
        std::abs(of.scatter.value - 1) >= kMinDifference && Root(WithInterval(ratio, degrees, kTailOfPart)).excludes(1);
    more = std::max(ratio, 1.0);
  }
  of.standard_error = std::sqrt(more * w.sum) / n;
  const int whole = std::max(static_cast<int>(degrees), 1);
  const double width95 = more > 1 ? StudentQuantile(whole, 0.025) : kNormal95;
  const double width99 = more > 1 ? StudentQuantile(whole, kTailOfOffset) : kNormal99;
  of.mean.low = of.mean.value - width95 * of.standard_error, of.mean.high = of.mean.value + width95 * of.standard_error;
  of.has_offset = std::abs(of.offset()) > width99 * of.standard_error;

  const double offset_squared = std::max(of.mean.value * of.mean.value - of.standard_error * of.standard_error, 0.0);
  const double scale = w.trace > 0 ? std::max(squares - n * offset_squared, 0.0) / w.trace : 0;
  const double variance = 2 * scale * scale * w.squares + 4 * scale * offset_squared * w.sum;
  of.rmse_degrees = variance > 0 ? 2 * squares * squares / variance : 0;
  of.rmse = Root(WithInterval(squares / n, of.rmse_degrees, 0.025));
  of.squared_z_degrees = n * n / w.correlations;
  of.squared_z = WithInterval(squared_z / n, of.squared_z_degrees, 0.025);
  return of;
}

}  // namespace albtpu::quality
