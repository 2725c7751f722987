#include "quality/crosscheck/pair_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace albtpu::quality {
namespace {

// Lines, square, and when each line saw it, in steps of kLook.
using Key = std::tuple<std::uint16_t, std::uint16_t, Place, std::int64_t, std::int64_t>;

Key KeyOf(const CrossPair& pair, double side) {
  const auto look = [](const PairedPoint& point) {
    return std::isfinite(point.pulse.time) ? static_cast<std::int64_t>(std::floor(point.pulse.time / kLook)) : 0;
  };
  return {pair.line_a, pair.line_b, PlaceOf(pair, side), look(pair.a), look(pair.b)};
}

std::map<Key, std::vector<std::size_t>> InSquares(const std::vector<CrossPair>& pairs, double side) {
  std::map<Key, std::vector<std::size_t>> squares;
  for (std::size_t i = 0; i < pairs.size(); ++i) squares[KeyOf(pairs[i], side)].push_back(i);
  return squares;
}

PairGroup GroupOf(const std::vector<CrossPair>& pairs, const Key& key, std::vector<std::size_t> numbers,
                  const SharedWaves& waves) {
  PairGroup group{.line_a = std::get<0>(key), .line_b = std::get<1>(key), .pairs = std::move(numbers)};
  const double n = group.count();
  double air = 0, each_sea = 0;
  group.sea_rows.resize(group.pairs.size());
  for (std::size_t i = 0; i < group.pairs.size(); ++i) {
    const CrossPair& pair = pairs[group.pairs[i]];
    group.mean += pair.difference / n;
    air += pair.variance_air() + pair.variance_slope;
    each_sea += pair.variance_sea();
    group.sea_rows[i] += pair.variance_sea();
    for (std::size_t j = 0; j < i; ++j) {
      const CrossPair& other = pairs[group.pairs[j]];
      const double shared = CovarianceOfSea(pair.a, other.a, waves) + CovarianceOfSea(pair.b, other.b, waves);
      group.sea_rows[i] += shared;
      group.sea_rows[j] += shared;
    }
    group.line_a_variance += pair.a.variance_line / n;
    group.line_b_variance += pair.b.variance_line / n;
    group.line_product += std::sqrt(double{pair.a.variance_line} * pair.b.variance_line) / n;
  }
  group.noise_of_sea = std::accumulate(group.sea_rows.begin(), group.sea_rows.end(), 0.0) / (n * n);
  group.noise = group.noise_of_sea + air / (n * n);
  group.of_pair = (air + each_sea) / n;
  return group;
}

}  // namespace

Place PlaceOf(const CrossPair& pair, double side) {
  return {static_cast<int>(std::floor(pair.x / side)), static_cast<int>(std::floor(pair.y / side))};
}

double CovarianceOfSea(const PairedPoint& a, const PairedPoint& b, const SharedWaves& waves) {
  const SeaParts shared = waves(a.pulse, b.pulse);
  const auto slopes = [](const PairedPoint& point) {
    return std::max(double{point.variance_sea} - point.variance_heights, 0.0);
  };
  return shared.slopes * std::sqrt(slopes(a) * slopes(b)) +
         shared.heights * std::sqrt(double{a.variance_heights} * b.variance_heights);
}

PairGroups GroupPairs(const std::vector<CrossPair>& across, double patch, const SharedWaves& waves) {
  constexpr int kPatchesAlongCell = 5, kMostDoublings = 6;
  PairGroups groups;
  groups.cell = kPatchesAlongCell * patch;
  auto squares = InSquares(across, groups.cell);
  for (int i = 0; i < kMostDoublings; ++i) {
    if (static_cast<double>(across.size()) >= kPairsOfCell * static_cast<double>(squares.size())) break;
    groups.cell *= 2;
    squares = InSquares(across, groups.cell);
  }
  groups.place = kCellsAlongPlace * groups.cell;
  std::map<Key, std::size_t> places;
  for (auto& [key, numbers] : InSquares(across, groups.place)) {
    places.emplace(key, groups.places.size());
    groups.places.push_back(GroupOf(across, key, std::move(numbers), waves));
  }
  for (auto& [key, numbers] : squares) {
    const CrossPair& first = across[numbers.front()];
    PairGroup& cell = groups.cells.emplace_back(GroupOf(across, key, std::move(numbers), waves));
    cell.within = places.at(KeyOf(first, groups.place));
  }
  return groups;
}

}  // namespace albtpu::quality
