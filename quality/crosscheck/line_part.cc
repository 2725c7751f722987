#include "quality/crosscheck/line_part.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "quality/crosscheck/pulse_part.h"
#include "sea/samples.h"

namespace albtpu::quality {
namespace {

constexpr double kSmallest = 1e-3;  // The smallest factor that is distinguished from 0.

// The places of two lines.
struct Overlap {
  std::vector<const PairGroup*> places;
  auto count() const { return static_cast<double>(places.size()); }
};
using Overlaps = std::map<std::pair<int, int>, Overlap>;

// Measured over predicted, of the variance of the means of cells about those of their places.
double ScatterOfCells(const PairGroups& groups) {
  struct OfPlace {
    double squares = 0, predicted = 0;
    int cells = 0;
  };
  std::vector<OfPlace> places(groups.places.size());
  for (const PairGroup& cell : groups.cells) {
    OfPlace& of = places[cell.within];
    of.squares += cell.count() * cell.mean * cell.mean;
    of.predicted += cell.count() * cell.noise;
    ++of.cells;
  }
  double squares = 0, predicted = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PairGroup& place = groups.places[i];
    if (places[i].cells < 2 || !(place.of_pair > 0)) continue;
    squares += (places[i].squares - place.count() * place.mean * place.mean) / place.of_pair;
    predicted += (places[i].predicted - place.count() * place.noise) / place.of_pair;
  }
  return predicted > 0 ? std::max(squares / predicted, 1.0) : 1;
}

// Q and its distribution as functions of the factor.
class SquaresOfLines {
 public:
  SquaresOfLines(const Overlaps& overlaps, double scatter) {
    for (const auto& [lines, overlap] : overlaps)
      for (const PairGroup* const place : overlap.places) {
        const double noise = scatter * place->noise, variance = place->line_variance();
        if (!(variance > 0)) continue;
        places_.push_back({variance / std::pow(variance + noise, 2) / overlap.count(), variance, noise});
        const Weighted& of = places_.back();
        q_ += of.weight * place->mean * place->mean;
        line_ += of.weight * variance;
        noise_ += of.weight * noise;
        each_ += std::pow(of.weight * variance, 2);
        of_line_[lines.first] += of.weight * place->line_a_variance;
        of_line_[lines.second] += of.weight * place->line_b_variance;
        of_both_[lines] += of.weight * place->line_product;
      }
    for (const auto& [line, sum] : of_line_) whole_ += sum * sum;
    for (const auto& [lines, sum] : of_both_) whole_ += 2 * sum * sum;
    Lasting(overlaps, scatter);
  }

  bool empty() const { return places_.empty(); }
  double lasting() const { return lasting_; }
  double Factor() const { return std::sqrt(std::max(q_ - noise_, 0.0) / line_); }

  double Degrees(double factor) const { return std::pow(Line(factor), 2) / SquaresOfLine(factor); }

  // The probabilities to find so large a Q at its lower end, and so small a one at its upper end.
  Estimate Interval(double larger, double smaller) const { return {Factor(), End(1 - larger), End(smaller)}; }

 private:
  struct Weighted {
    double weight, variance, noise;
  };

  // What lines have in t_1 and t_2 (line_part.h).
  double Line(double factor) const { return factor * factor * line_; }
  double SquaresOfLine(double factor) const {
    const double squared = factor * factor, lasting = std::max(squared - changing_, 0.0);
    const double shared = lasting * (squared + lasting) / 2;
    return shared * whole_ + (squared * squared - shared) * each_;
  }

  // The probability that Q is below what was found.
  double Below(double factor) const {
    const double line = Line(factor), of_line = SquaresOfLine(factor);
    double squares = of_line, cubes = of_line * of_line / line;
    for (const Weighted& place : places_) {
      const double of_lines = factor * factor * place.variance, all = of_lines + place.noise;
      squares += std::pow(place.weight, 2) * (all * all - of_lines * of_lines);
      cubes += std::pow(place.weight, 3) * (std::pow(all, 3) - std::pow(of_lines, 3));
    }
    const double degrees = std::pow(squares, 3) / (cubes * cubes);
    return ChiSquareBelow(std::max((q_ - line - noise_) * squares / cubes + degrees, 0.0), degrees);
  }

  // The factor at which Q is not above what was found with the probability `below`, which falls with the factor.
  double End(double below) const {
    double low = std::log(kSmallest), high = std::log(1 / kSmallest);
    if (Below(std::exp(low)) <= below) return 0;
    if (Below(std::exp(high)) > below) return std::numeric_limits<double>::infinity();
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (Below(std::exp(middle)) > below ? low : high) = middle;
    }
    return std::exp(low);
  }

  // Estimates the correlation of a line's error between two places of an overlap. The mean m_i of a place has the
  // variance v_i + noise_i; its weight is r_i = sqrt(v_i) / (v_i + noise_i), and w_i = r_i sqrt(v_i). The expected
  // value of r_i r_j m_i m_j is w_i w_j times the correlation, that of (r_i m_i)^2 without its noise is w_i^2. So both
  // sums are divided by those of the w. The squares exceed the products by the part that changes.
  void Lasting(const Overlaps& overlaps, double scatter) {
    double products = 0, squares = 0, weights = 0;
    for (const auto& [lines, overlap] : overlaps) {
      double sum = 0, sum_of_squares = 0, noise = 0, weight = 0, weight_of_squares = 0;
      int n = 0;
      for (const PairGroup* const place : overlap.places) {
        const double root = std::sqrt(place->line_variance()) / (place->line_variance() + scatter * place->noise);
        if (!std::isfinite(root)) continue;
        sum += root * place->mean;
        sum_of_squares += std::pow(root * place->mean, 2);
        noise += root * root * scatter * place->noise;
        const double of_place = root * std::sqrt(place->line_variance());
        weight += of_place;
        weight_of_squares += of_place * of_place;
        ++n;
      }
      const double weight_of_products = weight * weight - weight_of_squares;
      if (n < 2 || !(weight_of_products > 0)) continue;
      products += (sum * sum - sum_of_squares) * weight_of_squares / weight_of_products / n;
      squares += (sum_of_squares - noise) / n;
      weights += weight_of_squares / n;
    }
    changing_ = weights > 0 ? std::max(squares - products, 0.0) / weights : 0;
    lasting_ = squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 1;
  }

  std::vector<Weighted> places_;
  std::map<int, double> of_line_;
  std::map<std::pair<int, int>, double> of_both_;
  double q_ = 0, line_ = 0, noise_ = 0, each_ = 0, whole_ = 0, lasting_ = 1, changing_ = 0;
};

LineDifference DifferenceOf(const std::pair<int, int>& lines, const Overlap& overlap, double scatter, double lasting) {
  LineDifference difference{.line_a = lines.first, .line_b = lines.second};
  double sum = 0, noise = 0, line = 0;
  for (const PairGroup* const place : overlap.places) {
    difference.pairs += place->pairs.size();
    sum += place->count() * place->mean;
    noise += std::pow(place->count(), 2) * scatter * place->noise;
    line += place->count() * place->line_variance();
  }
  const auto count = static_cast<double>(difference.pairs);
  difference.mean = sum / count;
  difference.standard_error = std::sqrt(noise) / count;
  difference.predicted = std::sqrt(line / count * (lasting + (1 - lasting) / overlap.count()));
  return difference;
}

}  // namespace

LinePart TestLines(const PairGroups& groups) {
  Overlaps overlaps;
  for (const PairGroup& place : groups.places) overlaps[{place.line_a, place.line_b}].places.push_back(&place);
  const double scatter = ScatterOfCells(groups);
  const SquaresOfLines squares(overlaps, scatter);
  LinePart part;
  part.lasting = squares.lasting();
  part.noise = std::sqrt(scatter);
  if (!squares.empty()) {
    part.factor = squares.Interval(0.025, 0.025);
    part.degrees = squares.Degrees(std::max(part.factor->value, kSmallest));
    part.differs = std::abs(part.factor->value - 1) >= kMinDifference &&
                   squares.Interval(kTailOfLarger, kTailOfSmaller).excludes(1);
  }
  for (const auto& [lines, overlap] : overlaps)
    part.differences.push_back(DifferenceOf(lines, overlap, scatter, part.lasting));
  std::ranges::stable_sort(part.differences, std::ranges::greater(),
                           [](const LineDifference& line) { return std::abs(line.mean); });
  return part;
}

}  // namespace albtpu::quality
