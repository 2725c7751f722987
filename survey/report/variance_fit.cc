#include "survey/report/variance_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <random>

namespace albtpu::client {
namespace {

constexpr std::size_t kDraws = 1000;  // Of the bootstrap.
constexpr std::uint64_t kSeed = 22;   // Equal surveys give equal intervals.
constexpr double kTail95 = 0.025, kTail99 = 0.0025;
constexpr double kLeastFactor =
    0.05;  // Of a variance in weights: no pair may have none, or it would have all weight.

// What is fitted: air, sea, and the square of the distance.
enum Term : std::size_t { kAir, kSea, kRough, kTerms };
using Terms = std::array<double, kTerms>;

// Sums of weighted least squares: of products of the terms, and of the terms with the squared difference.
struct Sums {
  std::array<Terms, kTerms> products = {};
  Terms targets = {};
  double variance_squares = 0, variance_targets = 0;  // Of all of the predicted variance as one term.

  void Add(const Sums& other, double times) {
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) products[i][j] += times * other.products[i][j];
      targets[i] += times * other.targets[i];
    }
    variance_squares += times * other.variance_squares;
    variance_targets += times * other.variance_targets;
  }
};

Terms TermsOf(const CrossPair& pair) {
  return {pair.variance_air, pair.variance_sea, std::pow(pair.distance, 2)};
}

double VarianceBy(const Terms& factors, const CrossPair& pair) {
  const Terms terms = TermsOf(pair);
  double variance = pair.variance_slope;
  for (std::size_t i = 0; i < kTerms; ++i) variance += factors[i] * terms[i];
  return variance;
}

// The terms `used` (bits) by Gaussian elimination; nullopt if they cannot be told apart.
std::optional<Terms> Solve(const Sums& sums, unsigned used) {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < kTerms; ++i)
    if (used >> i & 1) index.push_back(i);
  const std::size_t n = index.size();
  std::array<std::array<double, kTerms + 1>, kTerms> rows = {};
  for (std::size_t i = 0; i < n; ++i) {
    // Scaled by the diagonal, so that units do not matter for what is nearly singular.
    const double scale = std::sqrt(sums.products[index[i]][index[i]]);
    if (!(scale > 0)) return std::nullopt;
    for (std::size_t j = 0; j < n; ++j)
      rows[i][j] = sums.products[index[i]][index[j]] / scale / std::sqrt(sums.products[index[j]][index[j]]);
    rows[i][n] = sums.targets[index[i]] / scale;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!(rows[k][k] > 1e-9)) return std::nullopt;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  Terms solved = {};
  std::array<double, kTerms> scaled = {};
  for (std::size_t k = n; k-- > 0;) {
    double value = rows[k][n];
    for (std::size_t j = k + 1; j < n; ++j) value -= rows[k][j] * scaled[j];
    scaled[k] = value / rows[k][k];
    solved[index[k]] = scaled[k] / std::sqrt(sums.products[index[k]][index[k]]);
  }
  return solved;
}

// Least squares without negative terms: the best of all subsets whose solution has none. `allowed`: bits of terms.
Terms SolveNonNegative(const Sums& sums, unsigned allowed) {
  Terms best = {};
  double least = 0;  // Of the sum of squares, less that of no term.
  for (unsigned used = 1; used < 1U << kTerms; ++used) {
    if ((used & ~allowed) != 0) continue;
    const std::optional<Terms> solved = Solve(sums, used);
    if (!solved.has_value() || std::ranges::min(*solved) < 0) continue;
    double squares = 0;
    for (std::size_t i = 0; i < kTerms; ++i) {
      squares -= 2 * (*solved)[i] * sums.targets[i];
      for (std::size_t j = 0; j < kTerms; ++j) squares += (*solved)[i] * sums.products[i][j] * (*solved)[j];
    }
    if (squares < least) best = *solved, least = squares;
  }
  return best;
}

// Sums of each place, weighted by the inverse square of the variance that `factors` give: the variance of a squared
// difference is twice its square.
std::vector<Sums> SumPlaces(const std::vector<CrossPair>& pairs, const Terms& factors, double rough) {
  std::map<Place, Sums> places;
  for (const CrossPair& pair : pairs) {
    const double weight = 1 / std::pow(VarianceBy(factors, pair), 2);
    const Terms terms = TermsOf(pair);
    const double square = std::pow(pair.difference, 2) - pair.variance_slope;
    Sums& sums = places[PlaceOf(pair)];
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) sums.products[i][j] += weight * terms[i] * terms[j];
      sums.targets[i] += weight * terms[i] * square;
    }
    const double predicted = terms[kAir] + terms[kSea];
    sums.variance_squares += weight * predicted * predicted;
    sums.variance_targets += weight * predicted * (square - rough * terms[kRough]);
  }
  std::vector<Sums> list;
  for (const auto& [place, sums] : places) list.push_back(sums);
  return list;
}

Sums Total(const std::vector<Sums>& places) {
  Sums total;
  for (const Sums& place : places) total.Add(place, 1);
  return total;
}

Sums Draw(const std::vector<Sums>& places, std::mt19937_64& random) {
  Sums drawn;
  for (std::size_t i = 0; i < places.size(); ++i) drawn.Add(places[random() % places.size()], 1);
  return drawn;
}

// A factor of standard deviations from a factor of variances and draws of it.
Estimate FactorOf(double value, std::vector<double> draws, double tail) {
  std::ranges::sort(draws);
  const auto at = [&](double fraction) {
    return std::sqrt(
        std::max(draws[static_cast<std::size_t>(fraction * static_cast<double>(draws.size() - 1))], 0.0));
  };
  return {std::sqrt(std::max(value, 0.0)), at(tail), at(1 - tail)};
}

double OneFactor(const Sums& sums) {
  return sums.variance_squares > 0 ? sums.variance_targets / sums.variance_squares : 0;
}

}  // namespace

Place PlaceOf(const CrossPair& pair) {
  return {static_cast<int>(std::floor(pair.x / kPlace)), static_cast<int>(std::floor(pair.y / kPlace))};
}

double PredictedVariance(const CrossPair& pair, double rough) { return VarianceBy({1, 1, rough}, pair); }

VarianceFit FitVariance(const std::vector<CrossPair>& pairs, double factor) {
  constexpr unsigned kAll = (1U << kTerms) - 1, kSmooth = kAll & ~(1U << kRough);
  const double guess = factor * factor;
  Terms factors = {guess, guess, 0};
  std::vector<Sums> places;
  for (int pass = 0; pass < 3; ++pass) {
    places = SumPlaces(pairs, factors, 0);
    factors = SolveNonNegative(Total(places), kAll);
    for (const Term term : {kAir, kSea}) factors[term] = std::max(factors[term], kLeastFactor * guess);
  }
  std::mt19937_64 random(kSeed);
  std::vector<double> rough;
  for (std::size_t i = 0; i < kDraws; ++i)
    rough.push_back(SolveNonNegative(Draw(places, random), kAll)[kRough]);
  std::ranges::sort(rough);
  const bool smooth = !(rough[static_cast<std::size_t>(kTail95 * kDraws)] > 0);
  if (smooth) factors[kRough] = 0;
  places = SumPlaces(pairs, factors, factors[kRough]);
  const unsigned allowed = smooth ? kSmooth : kAll;
  const Sums total = Total(places);
  const Terms fitted = SolveNonNegative(total, allowed);
  std::vector<double> air, sea, one;
  for (std::size_t i = 0; i < kDraws; ++i) {
    const Sums drawn = Draw(places, random);
    const Terms of_draw = SolveNonNegative(drawn, allowed);
    air.push_back(of_draw[kAir]);
    sea.push_back(of_draw[kSea]);
    one.push_back(OneFactor(drawn));
  }
  return {.factor = FactorOf(OneFactor(total), one, kTail95),
          .air = FactorOf(fitted[kAir], air, kTail95),
          .sea = FactorOf(fitted[kSea], sea, kTail95),
          .air_99 = FactorOf(fitted[kAir], air, kTail99),
          .sea_99 = FactorOf(fitted[kSea], sea, kTail99),
          .rough = factors[kRough]};
}

}  // namespace albtpu::client
