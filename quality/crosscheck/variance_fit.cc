#include "quality/crosscheck/variance_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sea/samples.h"

namespace albtpu::quality {
namespace {

constexpr double kTail95 = 0.025, kTail99 = 0.005;  // Of two-sided intervals.
// Of a variance in weights: no pair may have none, or it would have all weight.
constexpr double kMinFactor = 0.05;

// The fitted terms: air, sea, and the square of the distance.
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

Terms TermsOf(const CrossPair& pair) { return {pair.variance_air, pair.variance_sea, std::pow(pair.distance, 2)}; }

double VarianceBy(const Terms& factors, const CrossPair& pair) {
  const Terms terms = TermsOf(pair);
  double variance = pair.variance_slope;
  for (std::size_t i = 0; i < kTerms; ++i) variance += factors[i] * terms[i];
  return variance;
}

// The terms `used` (bits) by Gaussian elimination; nullopt if they are linearly dependent.
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

// The units of the jackknife: each has some of the cells, which are the pairs of two lines, or places.
struct Units {
  std::string name;
  std::vector<std::size_t> cell_of = {};  // By pair.
  std::size_t cells = 0;
  std::vector<std::vector<std::size_t>> members = {};  // Cells of each unit.
};

Units UnitsOf(const std::vector<CrossPair>& pairs) {
  Units units{.name = "lines"};
  std::map<std::pair<int, int>, std::size_t> cells;
  std::map<int, std::vector<std::size_t>> lines;
  for (const CrossPair& pair : pairs) {
    const auto [cell, is_new] = cells.try_emplace({pair.line_a, pair.line_b}, cells.size());
    if (is_new)
      for (const int line : {pair.line_a, pair.line_b}) lines[line].push_back(cell->second);
    units.cell_of.push_back(cell->second);
  }
  if (lines.size() >= kMinLines) {
    for (auto& [line, members] : lines) units.members.push_back(std::move(members));
  } else {
    units = {.name = "places"};
    cells.clear();
    for (const CrossPair& pair : pairs) {
      const auto [cell, is_new] = cells.try_emplace(PlaceOf(pair), cells.size());
      if (is_new) units.members.push_back({cell->second});
      units.cell_of.push_back(cell->second);
    }
  }
  units.cells = cells.size();
  return units;
}

// Sums of each cell, weighted by the inverse square of the variance that `factors` give: the variance of a squared
// difference is twice its square.
std::vector<Sums> SumCells(const std::vector<CrossPair>& pairs, const Units& units, const Terms& factors,
                           double rough) {
  std::vector<Sums> cells(units.cells);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const CrossPair& pair = pairs[k];
    const double weight = 1 / std::pow(VarianceBy(factors, pair), 2);
    const Terms terms = TermsOf(pair);
    const double square = std::pow(pair.difference, 2) - pair.variance_slope;
    Sums& sums = cells[units.cell_of[k]];
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) sums.products[i][j] += weight * terms[i] * terms[j];
      sums.targets[i] += weight * terms[i] * square;
    }
    const double predicted = terms[kAir] + terms[kSea];
    sums.variance_squares += weight * predicted * predicted;
    sums.variance_targets += weight * predicted * (square - rough * terms[kRough]);
  }
  return cells;
}

Sums Total(const std::vector<Sums>& cells) {
  Sums total;
  for (const Sums& cell : cells) total.Add(cell, 1);
  return total;
}

// `number` of all pairs, and without each unit.
template <typename Number>
std::vector<double> Jackknife(const std::vector<Sums>& cells, const Units& units, const Number& number) {
  const Sums total = Total(cells);
  std::vector<double> values = {number(total)};
  for (const std::vector<std::size_t>& members : units.members) {
    Sums left = total;
    for (const std::size_t cell : members) left.Add(cells[cell], -1);
    values.push_back(number(left));
  }
  return values;
}

// How far an interval with `tail` on each side reaches from the first of `values`, those of Jackknife. Infinitely far
// of less than two units.
double ReachOf(const std::vector<double>& values, double tail) {
  const auto count = static_cast<double>(values.size() - 1);
  if (count < 2) return std::numeric_limits<double>::infinity();
  double squares = 0;
  for (std::size_t i = 1; i < values.size(); ++i) squares += std::pow(values[i] - values[0], 2);
  return StudentQuantile(static_cast<int>(count) - 1, tail) * std::sqrt((count - 1) / count * squares);
}

// The standard error of a standard deviation is in proportion to it: the lower end is the value from which the estimate
// is as far, in its own standard errors, as it may be.
Estimate IntervalOf(const std::vector<double>& factors, double tail) {
  const double reach = ReachOf(factors, tail), value = factors[0];
  return {value, value > 0 ? value / (1 + reach / value) : 0, value + reach};
}

double OneFactor(const Sums& sums) {
  return sums.variance_squares > 0 ? std::sqrt(std::max(sums.variance_targets / sums.variance_squares, 0.0)) : 0;
}

}  // namespace

Place PlaceOf(const CrossPair& pair) {
  return {static_cast<int>(std::floor(pair.x / kPlace)), static_cast<int>(std::floor(pair.y / kPlace))};
}

double PredictedVariance(const CrossPair& pair, double rough) { return VarianceBy({1, 1, rough}, pair); }

VarianceFit FitVariance(const std::vector<CrossPair>& pairs, double factor) {
  constexpr unsigned kAll = (1U << kTerms) - 1, kSmooth = kAll & ~(1U << kRough);
  const Units units = UnitsOf(pairs);
  const double guess = factor * factor;
  Terms factors = {guess, guess, 0};
  std::vector<Sums> cells;
  for (int pass = 0; pass < 3; ++pass) {
    cells = SumCells(pairs, units, factors, 0);
    factors = SolveNonNegative(Total(cells), kAll);
    for (const Term term : {kAir, kSea}) factors[term] = std::max(factors[term], kMinFactor * guess);
  }
  const auto rough = [](const Sums& sums) { return SolveNonNegative(sums, kAll)[kRough]; };
  const std::vector<double> roughness = Jackknife(cells, units, rough);
  const bool smooth = !(roughness[0] > ReachOf(roughness, kTail95));
  if (smooth) factors[kRough] = 0;
  cells = SumCells(pairs, units, factors, factors[kRough]);
  const unsigned allowed = smooth ? kSmooth : kAll;
  const auto of_share = [&](Term term) {
    return Jackknife(cells, units, [=](const Sums& sums) { return std::sqrt(SolveNonNegative(sums, allowed)[term]); });
  };
  const std::vector<double> air = of_share(kAir), sea = of_share(kSea);
  return {.factor = IntervalOf(Jackknife(cells, units, OneFactor), kTail95),
          .air = IntervalOf(air, kTail95),
          .sea = IntervalOf(sea, kTail95),
          .air_differs = IntervalOf(air, kTail99).excludes(1),
          .sea_differs = IntervalOf(sea, kTail99).excludes(1),
          .rough = factors[kRough],
          .units = units.name};
}

}  // namespace albtpu::quality
