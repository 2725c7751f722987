#include "quality/report/survey_grid.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/s44.h"

namespace albtpu::quality {
namespace {

constexpr double kGreatestIndex = 1e9;  // Of a column or row: so that two tile numbers fit 64 bits.

// Floor of a / SurveyGrid::kTile for a of either sign.
std::int64_t TileOf(std::int64_t index) {
  return index >= 0 ? index / SurveyGrid::kTile : -((-index + SurveyGrid::kTile - 1) / SurveyGrid::kTile);
}

std::uint64_t KeyOf(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 |
         static_cast<std::uint32_t>(row);
}

absl::Status TooLarge(const std::string& why) {
  return absl::ResourceExhaustedError(absl::StrCat(
      "the grid is too large (", why, "); give larger cells by --cell, or fewer files at a time"));
}

}  // namespace

absl::Status SurveyGrid::CheckExtent(double min_x, double max_x, double min_y, double max_y) const {
  const double columns = std::ceil((max_x - min_x) / cell_) + 1;
  const double rows = std::ceil((max_y - min_y) / cell_) + 1;
  const double farthest = std::max({std::abs(min_x), std::abs(max_x), std::abs(min_y), std::abs(max_y)});
  if (columns * rows <= kMaxCells && farthest / cell_ < kGreatestIndex) return absl::OkStatus();
  return TooLarge(absl::StrFormat("%.0f x %.0f cells of %g, at most %.0f", columns, rows, cell_, kMaxCells));
}

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
  const auto within = [](std::int64_t index) {
    return static_cast<std::size_t>(index - TileOf(index) * kTile);
  };
  const std::size_t blocks = tile->blocks();
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
  take(point.depth, cell.depth);
  take(point.thu, cell.thu);
  take(point.tvu, cell.tvu);
  const std::array<double, 4> shares = VerticalShares(point, coverage_);
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
    if (static_cast<double>(columns()) * static_cast<double>(rows()) > 1.1 * kMaxCells)
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
    for (std::size_t i = 0; i < Tile::kCells; ++i)
      if (const GridCell* cell = found->second->Find(i); cell != nullptr)
        cells[i / kTile * columns() + west + i % kTile] = *cell;
  }
}

}  // namespace albtpu::quality
