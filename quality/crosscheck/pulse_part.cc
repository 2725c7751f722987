#include "quality/crosscheck/pulse_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sea/samples.h"

namespace albtpu::quality {
namespace {

constexpr double kTail95 = 0.025;  // Of two-sided intervals.
// Of a variance in weights: no sample may have none, or it would have all weight.
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

Terms TermsOf(const SquaredDifference& sample) { return {sample.air, sample.sea, sample.distance}; }

double VarianceBy(const Terms& factors, const SquaredDifference& sample) {
  const Terms terms = TermsOf(sample);
  double variance = sample.slope;
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

// Sums of each place, weighted by the inverse square of the variance that `factors` give: the variance of a squared
// difference is twice its square.
std::vector<Sums> SumPlaces(const std::vector<SquaredDifference>& samples, const Terms& factors, double rough) {
  std::map<Place, Sums> places;
  for (const SquaredDifference& sample : samples) {
    const double weight = 1 / std::pow(VarianceBy(factors, sample), 2);
    const Terms terms = TermsOf(sample);
    const double square = sample.square - sample.slope;
    Sums& sums = places[sample.place];
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) sums.products[i][j] += weight * terms[i] * terms[j];
      sums.targets[i] += weight * terms[i] * square;
    }
    if (!sample.across) continue;
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

// `number` of all places, and without each.
template <typename Number>
std::vector<double> Jackknife(const std::vector<Sums>& places, const Number& number) {
  const Sums total = Total(places);
  std::vector<double> values = {number(total)};
  for (const Sums& place : places) {
    Sums left = total;
    left.Add(place, -1);
    values.push_back(number(left));
  }
  return values;
}

// How far an interval with `tail` on each side reaches from the first of `values`, those of Jackknife. Infinitely far
// of less than two places.
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

// Whether an interval lies on the side of 1 on which the part does.
bool LiesOnSide(const Estimate& interval, bool above) { return above ? interval.low > 1 : interval.high < 1; }

}  // namespace

std::vector<SquaredDifference> SquaredDifferences(const PatchPairs& pairs, const PairGroups& groups,
                                                  const SharedWaves& waves) {
  std::vector<SquaredDifference> samples;
  for (const PairGroup& cell : groups.cells) {
    const double n = cell.count();
    if (n < 2) continue;
    double air = 0, slope = 0, distance = 0;  // Sums.
    for (const std::size_t i : cell.pairs) {
      const CrossPair& pair = pairs.across[i];
      air += pair.variance_air(), slope += pair.variance_slope, distance += std::pow(pair.distance, 2);
    }
    // The variance of a difference less the mean: its own, less twice its covariance with the mean, and that of the
    // mean.
    const auto less_mean = [n](double own, double sum) { return own * (1 - 2 / n) + sum / (n * n); };
    for (std::size_t k = 0; k < cell.pairs.size(); ++k) {
      const CrossPair& pair = pairs.across[cell.pairs[k]];
      const double sea = pair.variance_sea() - 2 * cell.sea_rows[k] / n + cell.noise_of_sea;
      samples.push_back({.place = PlaceOf(pair, groups.place),
                         .square = std::pow(pair.difference - cell.mean, 2),
                         .air = less_mean(pair.variance_air(), air),
                         .sea = std::max(sea, 0.0),
                         .slope = less_mean(pair.variance_slope, slope),
                         .distance = less_mean(std::pow(pair.distance, 2), distance)});
    }
  }
  for (const CrossPair& pair : pairs.within) {
    if (pair.a.pulse.sea == PulseOnWater::kNoSea) continue;
    samples.push_back({.place = PlaceOf(pair, groups.place),
                       .across = false,
                       .square = std::pow(pair.difference, 2),
                       .air = pair.variance_air(),
                       .sea = std::max(pair.variance_sea() - 2 * CovarianceOfSea(pair.a, pair.b, waves), 0.0),
                       .slope = pair.variance_slope,
                       .distance = std::pow(pair.distance, 2)});
  }
  std::erase_if(samples, [](const SquaredDifference& sample) { return !(sample.air + sample.sea > 0); });
  return samples;
}

PulsePart FitPulses(const std::vector<SquaredDifference>& samples, double guess) {
  PulsePart part;
  part.factor.value = part.air.value = part.sea.value = std::nan("");
  if (samples.empty()) return part;
  constexpr unsigned kAll = (1U << kTerms) - 1, kSmooth = kAll & ~(1U << kRough);
  const double squared = guess * guess;
  Terms factors = {squared, squared, 0};
  std::vector<Sums> places;
  for (int pass = 0; pass < 3; ++pass) {
    places = SumPlaces(samples, factors, 0);
    factors = SolveNonNegative(Total(places), kAll);
    for (const Term term : {kAir, kSea}) factors[term] = std::max(factors[term], kMinFactor * squared);
  }
  const std::vector<double> roughness =
      Jackknife(places, [](const Sums& sums) { return SolveNonNegative(sums, kAll)[kRough]; });
  const bool smooth = !(roughness[0] > ReachOf(roughness, kTail95));
  if (smooth) factors[kRough] = 0;
  places = SumPlaces(samples, factors, factors[kRough]);
  const unsigned allowed = smooth ? kSmooth : kAll;
  const auto of = [&](Term term) {
    return Jackknife(places, [=](const Sums& sums) { return std::sqrt(SolveNonNegative(sums, allowed)[term]); });
  };
  const std::vector<double> one = Jackknife(places, OneFactor), air = of(kAir), sea = of(kSea);
  part.factor = IntervalOf(one, kTail95);
  part.air = IntervalOf(air, kTail95);
  part.sea = IntervalOf(sea, kTail95);
  part.rough = factors[kRough];
  part.places = places.size();
  part.differs = std::abs(part.factor.value - 1) >= kMinDifference && IntervalOf(one, kTailOfPart).excludes(1);
  if (part.differs) {
    const bool above = part.factor.value > 1;
    const bool of_air = LiesOnSide(IntervalOf(air, kTailOfPart), above),
               of_sea = LiesOnSide(IntervalOf(sea, kTailOfPart), above);
    if (of_air != of_sea) part.named = of_air ? "air" : "sea";
  }
  return part;
}

}  // namespace albtpu::quality
