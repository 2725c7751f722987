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

// Q and its mean and variance as functions of the factor.
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

  double Degrees(double factor) const {
    const double squared = factor * factor, mean = Mean(factor);
    double variance = lasting_ * squared * squared * whole_;
    for (const Weighted& place : places_)
      variance += std::pow(place.weight, 2) * (std::pow(squared * place.variance + place.noise, 2) -
                                               lasting_ * std::pow(squared * place.variance, 2));
    return mean * mean / variance;
  }

  Estimate Interval(double tail) const { return {Factor(), End(1 - tail), End(tail)}; }

 private:
  struct Weighted {
    double weight, variance, noise;
  };

  double Mean(double factor) const { return factor * factor * line_ + noise_; }

  // The factor at which Q is not above what was found with the probability `below`, which falls with the factor.
  double End(double below) const {
    const auto probability = [this](double factor) {
      const double degrees = Degrees(factor);
      return ChiSquareBelow(degrees * q_ / Mean(factor), degrees);
    };
    double low = std::log(1e-3), high = std::log(1e3);
    if (noise_ > 0 && probability(0) <= below) return 0;
    if (probability(std::exp(high)) > below) return std::numeric_limits<double>::infinity();
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (probability(std::exp(middle)) > below ? low : high) = middle;
    }
    return std::exp(low);
  }

  // The correlation of a line's error between two places of an overlap. A mean m_i has the variance v_i + noise_i, and
  // gets the weight r_i = sqrt(v_i) / (v_i + noise_i). With w_i = r_i sqrt(v_i), r_i r_j m_i m_j is in the mean w_i w_j
  // times the correlation, and (r_i m_i)^2 less its noise is w_i^2: products and squares are compared by these.
  void Lasting(const Overlaps& overlaps, double scatter) {
    double products = 0, squares = 0;
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
    }
    lasting_ = squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 1;
  }

  std::vector<Weighted> places_;
  std::map<int, double> of_line_;
  std::map<std::pair<int, int>, double> of_both_;
  double q_ = 0, line_ = 0, noise_ = 0, whole_ = 0, lasting_ = 1;
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
    part.degrees = squares.Degrees(1);
    part.factor = squares.Interval(0.025);
    part.differs = std::abs(part.factor->value - 1) >= kMinDifference && squares.Interval(kTailOfPart).excludes(1);
  }
  for (const auto& [lines, overlap] : overlaps)
    part.differences.push_back(DifferenceOf(lines, overlap, scatter, part.lasting));
  std::ranges::stable_sort(part.differences, std::ranges::greater(),
                           [](const LineDifference& line) { return std::abs(line.mean); });
  return part;
}

}  // namespace albtpu::quality
