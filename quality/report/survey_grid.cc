#include "quality/report/survey_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "budget/total/error_ellipse.h"
#include "tables/s44.h"

namespace albtpu::quality {
namespace {

using nlohmann::ordered_json;

ordered_json SpreadJson(const annotate::LengthSpread& spread) {
  return {{"mean", spread.mean()},
          {"median", spread.quantile(0.5)},
          {"p95", spread.quantile(0.95)},
          {"greatest", spread.greatest()}};
}

}  // namespace

ClassJudge::ClassJudge(const std::vector<Specification>& specifications) {
  for (const Specification& each : specifications)
    classes_.insert(classes_.end(), each.classes.begin(), each.classes.end());
  assert(classes_.size() <= kMaxClasses);
}

std::uint64_t ClassJudge::Met(const AnnotatedPoint& point) const {
  if (!point.has_number) return 0;
  const HorizontalRadius horizontal(point.variance_x, point.variance_y, point.covariance_xy);
  const double sigma_vertical = std::sqrt(point.variance_z);
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const SpecificationClass& limits = classes_[i];
    const bool thu =
        !limits.horizontal.has_value() ||
        horizontal.At(limits.coverage) + std::abs(point.bias_along_beam) <= limits.horizontal->At(point.depth);
    const bool tvu = !limits.vertical.has_value() ||
                     VerticalFactor(limits.coverage) * sigma_vertical + std::abs(point.bias_vertical) <=
                         limits.vertical->At(point.depth);
    met |= static_cast<std::uint64_t>(thu && tvu) << i;
  }
  return met;
}

double ClassJudge::Margin(const AnnotatedPoint& point, std::size_t c) const {
  const SpecificationClass& limits = classes_[c];
  double margin = std::numeric_limits<double>::infinity();
  const auto take = [&](const std::optional<Limit>& limit, double uncertainty, float bias) {
    if (!limit.has_value()) return;
    const double left = limit->At(point.depth) - std::abs(bias);
    if (left < 0) margin = 0;
    if (uncertainty > 0) margin = std::min(margin, std::max(left, 0.0) / uncertainty);
  };
  const HorizontalRadius horizontal(point.variance_x, point.variance_y, point.covariance_xy);
  take(limits.horizontal, horizontal.At(limits.coverage), point.bias_along_beam);
  take(limits.vertical, VerticalFactor(limits.coverage) * std::sqrt(point.variance_z), point.bias_vertical);
  return margin;
}

std::array<double, kVerticalShareNames.size()> VerticalShares(const AnnotatedPoint& point, Coverage coverage) {
  const auto variance = [factor = VerticalFactor(coverage)](float tvu) { return std::pow(tvu / factor, 2); };
  const double air = variance(point.tvu_air), sea = variance(point.tvu_sea), water = variance(point.tvu_water);
  const double extra = variance(point.tvu_extra);
  return {air, sea, water, std::max(point.variance_z - air - sea - water - extra, 0.0), extra};
}

void PointTally::Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage) {
  ++points_;
  if (!point.has_number) return;
  thu_.Add(point.thu);
  tvu_.Add(point.tvu);
  const auto shares = VerticalShares(point, coverage);
  for (std::size_t i = 0; i < shares.size(); ++i) shares_[i] += shares[i];
  const double factor = VerticalFactor(coverage);
  pulse_ += std::pow(point.tvu_pulse / factor, 2);
  line_ += std::pow(point.tvu_line / factor, 2);
  bias_along_beam_ += point.bias_along_beam;
  bias_vertical_ += point.bias_vertical;
  elevation_ += point.z;
  lowest_ = std::min(lowest_, point.z);
  highest_ = std::max(highest_, point.z);
  for (std::size_t i = 0; met >> i != 0; ++i) {
    met_[i] += met >> i & 1;
    if (i + 1 == ClassJudge::kMaxClasses) break;
  }
}

void PointTally::Merge(const PointTally& other) {
  points_ += other.points_;
  thu_.Merge(other.thu_);
  tvu_.Merge(other.tvu_);
  for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] += other.shares_[i];
  pulse_ += other.pulse_;
  line_ += other.line_;
  bias_along_beam_ += other.bias_along_beam_;
  bias_vertical_ += other.bias_vertical_;
  elevation_ += other.elevation_;
  lowest_ = std::min(lowest_, other.lowest_);
  highest_ = std::max(highest_, other.highest_);
  for (std::size_t i = 0; i < met_.size(); ++i) met_[i] += other.met_[i];
}

ordered_json PointTally::Json(std::size_t classes) const {
  ordered_json json = {{"points", points_}, {"with_number", with_number()}};
  if (with_number() > 0) {
    json["thu"] = SpreadJson(thu_);
    json["tvu"] = SpreadJson(tvu_);
    const auto count = static_cast<double>(with_number());
    json["bias_along_beam"] = bias_along_beam_ / count;
    json["bias_vertical"] = bias_vertical_ / count;
    json["elevation"] = {{"mean", elevation_ / count}, {"least", lowest_}, {"greatest", highest_}};
    double total = 0;
    for (const double share : shares_) total += share;
    for (std::size_t i = 0; i < shares_.size(); ++i)
      json["shares_vertical"][kVerticalShareNames[i]] = total > 0 ? shares_[i] / total : 0;
    const auto of_total = [total](double sum) { return total > 0 ? sum / total : 0; };
    json["groups_vertical"] = {{"pulse", of_total(pulse_)},
                               {"line", of_total(line_)},
                               {"survey", std::max(of_total(total - pulse_ - line_), 0.0)}};
  }
  json["meeting"] = std::vector<std::uint64_t>(met_.begin(), met_.begin() + static_cast<std::ptrdiff_t>(classes));
  return json;
}

void DepthTallies::Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage) {
  bins_[std::min(static_cast<std::size_t>(point.depth), bins_.size() - 1)].Add(point, met, coverage);
}

ordered_json DepthTallies::Json(std::size_t classes, const std::vector<int>& ends) const {
  ordered_json list = ordered_json::array();
  const auto end_after = [&](int begin) {
    const auto end = std::ranges::upper_bound(ends, begin);
    return ends.empty() ? begin + 1 : end != ends.end() ? std::min(*end, kBins) : kBins;
  };
  for (int begin = 0; begin < kBins; begin = end_after(begin)) {
    PointTally merged;
    const int end = end_after(begin);
    for (int i = begin; i < end; ++i) merged.Merge(bins_[static_cast<std::size_t>(i)]);
    if (merged.points() == 0) continue;
    ordered_json json = {{"from", begin}, {"to", nullptr}};
    if (end < kBins) json["to"] = end;
    json.update(merged.Json(classes));
    list.push_back(std::move(json));
  }
  return list;
}

namespace {

constexpr double kGreatestIndex = 1e9;  // Of a column or row: so that two tile numbers fit 64 bits.

// Floor of a / SurveyGrid::kTile for a of either sign.
std::int64_t TileOf(std::int64_t index) {
  return index >= 0 ? index / SurveyGrid::kTile : -((-index + SurveyGrid::kTile - 1) / SurveyGrid::kTile);
}

std::uint64_t KeyOf(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 | static_cast<std::uint32_t>(row);
}

absl::Status TooLarge(const std::string& why) {
  return absl::ResourceExhaustedError(
      absl::StrCat("the grid is too large (", why, "); give larger cells by --cell, or fewer files at a time"));
}

}  // namespace

void SurveyGrid::Add(const AnnotatedPoint& point, std::uint8_t best_order) {
  if (!status_.ok()) return;
  const double x = std::floor(point.x / cell_), y = std::floor(point.y / cell_);
  if (!(std::abs(x) < kGreatestIndex && std::abs(y) < kGreatestIndex)) {
    status_ = TooLarge(absl::StrFormat("a point lies at %g, %g", point.x, point.y));
    return;
  }
  const auto column = static_cast<std::int64_t>(x), row = static_cast<std::int64_t>(y);
  Tile* const tile = TileAt(TileOf(column), TileOf(row));
  if (tile == nullptr) return;
  const auto within = [](std::int64_t index) { return static_cast<std::size_t>(index - TileOf(index) * kTile); };
  const std::size_t blocks = tile->blocks();
  if (blocks == 0) tile->base = point.z;
  GridCell& cell = tile->At(tile->PlaceOf(within(row) * kTile + within(column)));
  bytes_ += (tile->blocks() - blocks) * sizeof(Tile::Block);
  ++cell.points;
  cell.gap = std::max<std::uint32_t>(cell.gap, static_cast<std::uint32_t>(point.gap));
  if (!point.has_number) return;
  ++cell.with_number;
  // Means that run: a sum of very many floats would lose the last ones.
  const auto take = [count = static_cast<double>(cell.with_number)](double value, float& mean) {
    mean += static_cast<float>((value - mean) / count);
  };
  take(point.z - tile->base, cell.elevation);
  take(point.depth, cell.depth);
  take(point.thu, cell.thu);
  take(point.tvu, cell.tvu);
  const auto shares = VerticalShares(point, coverage_);
  for (std::size_t i = 0; i < shares.size(); ++i) take(shares[i], cell.shares[i]);
  constexpr std::uint8_t kNone = kS44Orders.size() + 1;
  cell.worst_order = std::max<std::uint32_t>(cell.worst_order, best_order == 0 ? kNone : best_order);
}

std::size_t SurveyGrid::Tile::PlaceOf(std::size_t cell) {
  std::uint16_t& place = places_[cell];
  if (place == 0) {
    if (used_ % kBlock == 0) blocks_.push_back(std::make_unique<Block>());
    place = ++used_;
  }
  return place - 1U;
}

SurveyGrid::Tile* SurveyGrid::TileAt(std::int64_t column, std::int64_t row) {
  const std::uint64_t key = KeyOf(column, row);
  if (last_ != nullptr && key == last_key_) return last_;
  std::unique_ptr<Tile>& tile = tiles_[key];
  if (tile == nullptr) {
    bytes_ += sizeof(Tile);
    if (bytes_ > kMostBytes) {
      status_ = TooLarge(absl::StrCat("its cells with points need more than ", kMostBytes >> 20, " MiB"));
      tiles_.erase(key);
      return nullptr;
    }
    tile = std::make_unique<Tile>();
    const bool first = tiles_.size() == 1;
    min_column_ = first ? column : std::min(min_column_, column);
    max_column_ = first ? column : std::max(max_column_, column);
    min_row_ = first ? row : std::min(min_row_, row);
    max_row_ = first ? row : std::max(max_row_, row);
    if (static_cast<double>(columns()) * static_cast<double>(rows()) > kMaxCells)
      status_ = TooLarge(absl::StrFormat("points lie %d x %d cells apart", columns(), rows()));
  }
  last_key_ = key;
  last_ = tile.get();
  return last_;
}

void SurveyGrid::Strip(std::size_t strip, std::vector<GridCell>& cells) const {
  cells.assign(columns() * kTile, {});
  const std::int64_t row = min_row_ + static_cast<std::int64_t>(strip);
  for (std::int64_t column = min_column_; column <= max_column_; ++column) {
    const auto found = tiles_.find(KeyOf(column, row));
    if (found == tiles_.end()) continue;
    const std::size_t west = static_cast<std::size_t>(column - min_column_) * kTile;
    for (std::size_t i = 0; i < Tile::kCells; ++i) {
      const GridCell* const stored = found->second->Find(i);
      if (stored == nullptr) continue;
      GridCell& cell = cells[i / kTile * columns() + west + i % kTile] = *stored;
      if (cell.with_number > 0) cell.elevation = static_cast<float>(found->second->base + cell.elevation);
    }
  }
}

}  // namespace albtpu::quality
