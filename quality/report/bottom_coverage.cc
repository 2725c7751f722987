#include "quality/report/bottom_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

namespace albtpu::quality {
namespace {

constexpr double kLargeSpacings = 4;   // Of the side of a void that counts as large.
constexpr double kFarthestCell = 1e9;  // Of a column or row, as that of SurveyGrid.
// Points in a cell, or cells of a void; more count as this many.
constexpr std::size_t kMostInCell = 100'000;

std::int64_t TileNumber(std::int64_t index, std::int64_t tile) {
  return index >= 0 ? index / tile : -((-index + tile - 1) / tile);
}

std::uint64_t TileKey(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 | static_cast<std::uint32_t>(row);
}

// Cells of a row that lie side by side.
struct VoidSpan {
  std::size_t begin = 0, end = 0, component = 0;
};

struct VoidPart {
  BottomVoid of;
  std::size_t longest = 0;  // Cells of a row.

  void Take(const VoidPart& other) {
    of.cells += other.of.cells;
    if (other.longest > longest) longest = other.longest, of.x = other.of.x, of.y = other.of.y;
  }
};

// Joins spans of one row after the other. Memory is that of two rows: a component that no span of a row continues is
// complete.
class VoidFinder {
 public:
  template <typename Complete>
  void AddRow(std::vector<VoidSpan> spans, double cell, double first_x, double y, const Complete& complete) {
    std::vector<VoidPart> components = std::move(open_);
    std::vector<std::size_t> parents(components.size() + spans.size());
    std::iota(parents.begin(), parents.end(), 0);
    const auto root = [&](std::size_t i) {
      while (parents[i] != i) i = parents[i] = parents[parents[i]];
      return i;
    };
    std::size_t above = 0;
    for (VoidSpan& span : spans) {
      span.component = components.size();
      const std::size_t length = span.end - span.begin;
      const double middle = static_cast<double>(span.begin + span.end) / 2;
      components.push_back({.of = {.cells = length, .x = first_x + middle * cell, .y = y}, .longest = length});
      while (above < last_.size() && last_[above].end <= span.begin) ++above;
      for (std::size_t i = above; i < last_.size() && last_[i].begin < span.end; ++i) {
        const std::size_t a = root(last_[i].component), b = root(span.component);
        if (a == b) continue;
        components[a].Take(components[b]);
        parents[b] = a;
      }
    }
    // Those of this row stay open, and are numbered anew.
    std::vector<std::size_t> numbers(components.size(), std::numeric_limits<std::size_t>::max());
    open_.clear();
    for (VoidSpan& span : spans) {
      const std::size_t of = root(span.component);
      if (numbers[of] == std::numeric_limits<std::size_t>::max()) {
        numbers[of] = open_.size();
        open_.push_back(components[of]);
      }
      span.component = numbers[of];
    }
    for (std::size_t i = 0; i < components.size(); ++i)
      if (parents[i] == i && numbers[i] == std::numeric_limits<std::size_t>::max()) complete(components[i].of);
    last_ = std::move(spans);
  }

  template <typename Complete>
  void Finish(const Complete& complete) {
    for (const VoidPart& component : open_) complete(component.of);
  }

 private:
  std::vector<VoidPart> open_;
  std::vector<VoidSpan> last_;
};

// Where the points of rows and columns begin and end.
struct RowsAndColumns {
  std::vector<std::size_t> row_begin, row_end, column_begin, column_end;

  RowsAndColumns(std::size_t rows, std::size_t columns)
      : row_begin(rows, columns), row_end(rows, 0), column_begin(columns, rows), column_end(columns, 0) {}
  void Add(std::size_t row, std::size_t column) {
    row_begin[row] = std::min(row_begin[row], column);
    row_end[row] = std::max(row_end[row], column + 1);
    column_begin[column] = std::min(column_begin[column], row);
    column_end[column] = std::max(column_end[column], row + 1);
  }
  bool Has(std::size_t row, std::size_t column) const {
    return row >= column_begin[column] && row < column_end[column];
  }
};

std::uint64_t CellQuantile(const std::vector<std::uint64_t>& counts, std::uint64_t cells, double fraction) {
  std::uint64_t reached = 0;
  for (std::size_t points = 0; points < counts.size(); ++points) {
    reached += counts[points];
    if (static_cast<double>(reached) >= fraction * static_cast<double>(cells)) return points;
  }
  return 0;
}

}  // namespace

void LandCells::Add(const DryPoint& dry) {
  const double x = std::floor(dry.point.x / cell_), y = std::floor(dry.point.y / cell_);
  if (dry.of_water_surface || !(std::abs(x) < kFarthestCell && std::abs(y) < kFarthestCell)) return;
  const auto column = static_cast<std::int64_t>(x), row = static_cast<std::int64_t>(y);
  const std::int64_t tile_column = TileNumber(column, kTile), tile_row = TileNumber(row, kTile);
  const std::uint64_t key = TileKey(tile_column, tile_row);
  if (last_ == nullptr || key != last_key_) {
    if (tiles_.size() >= kMostTiles && !tiles_.contains(key)) return;
    last_ = &tiles_[key];
    last_key_ = key;
  }
  last_->set(static_cast<std::size_t>((row - tile_row * kTile) * kTile + column - tile_column * kTile));
}

bool LandCells::Has(std::int64_t column, std::int64_t row) const {
  const std::int64_t tile_column = TileNumber(column, kTile), tile_row = TileNumber(row, kTile);
  const auto found = tiles_.find(TileKey(tile_column, tile_row));
  return found != tiles_.end() &&
         found->second.test(static_cast<std::size_t>((row - tile_row * kTile) * kTile + column - tile_column * kTile));
}

double BottomCoverage::spacing() const { return 1 / std::sqrt(density()); }

BottomCoverage BottomCoverage::Of(const SurveyGrid& grid, const LandCells& land, double metres_per_unit) {
  constexpr std::size_t kRows = SurveyGrid::kTile;
  const std::size_t rows = grid.rows(), columns = grid.columns();
  BottomCoverage coverage;
  coverage.cell = grid.cell() * metres_per_unit;
  RowsAndColumns extents(rows, columns);
  std::vector<std::uint64_t> counts(kMostInCell + 1);
  std::vector<bool> has_points(rows * columns);
  std::vector<GridCell> cells;
  for (std::size_t strip = 0; strip < rows / kRows; ++strip) {
    grid.Strip(strip, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].points == 0) continue;
      const std::size_t row = strip * kRows + i / columns, column = i % columns;
      extents.Add(row, column);
      has_points[row * columns + column] = true;
      coverage.points += cells[i].points;
      ++coverage.covered;
      ++counts[std::min<std::size_t>(cells[i].points, kMostInCell)];
    }
  }
  coverage.median = CellQuantile(counts, coverage.covered, 0.5);
  coverage.least_but_5 = CellQuantile(counts, coverage.covered, 0.05);

  VoidFinder finder;
  std::vector<std::uint64_t> sizes;  // Of voids, by their cells; the last has all that are greater.
  sizes.resize(kMostInCell + 1);
  const auto complete = [&](const BottomVoid& of) {
    ++coverage.voids;
    ++sizes[std::min<std::uint64_t>(of.cells, kMostInCell)];
    if (of.cells > coverage.largest.cells) coverage.largest = of;
  };
  coverage.cells = coverage.covered;
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<VoidSpan> spans;
    for (std::size_t column = extents.row_begin[row]; column < extents.row_end[row]; ++column) {
      if (has_points[row * columns + column] || !extents.Has(row, column)) continue;
      if (land.Has(grid.first_column() + static_cast<std::int64_t>(column),
                   grid.first_row() + static_cast<std::int64_t>(row)))
        continue;
      ++coverage.cells;
      if (spans.empty() || spans.back().end != column) spans.push_back({.begin = column, .end = column});
      ++spans.back().end;
    }
    finder.AddRow(std::move(spans), grid.cell(), static_cast<double>(grid.first_column()) * grid.cell(),
                  (static_cast<double>(grid.first_row() + static_cast<std::int64_t>(row)) + 0.5) * grid.cell(),
                  complete);
  }
  finder.Finish(complete);
  const double least = std::pow(kLargeSpacings * coverage.spacing() / coverage.cell, 2);
  for (std::size_t cells_of = 1; cells_of < sizes.size(); ++cells_of)
    if (static_cast<double>(cells_of) >= least) coverage.large_voids += sizes[cells_of];
  return coverage;
}

nlohmann::ordered_json BottomCoverage::Json() const {
  const double of_cell = cell * cell;
  nlohmann::ordered_json json = {
      {"cell", cell},
      {"surveyed_area", area()},
      {"covered_share", static_cast<double>(covered) / static_cast<double>(cells)},
      {"empty_share", static_cast<double>(cells - covered) / static_cast<double>(cells)},
      {"points_per_square_metre", density()},
      {"spacing", spacing()},
      {"points_of_covered_cells",
       {{"mean", static_cast<double>(points) / static_cast<double>(covered)}, {"median", median}, {"p5", least_but_5}}},
      {"voids", voids},
      {"large_void_area", std::pow(kLargeSpacings * spacing(), 2)},
      {"large_voids", large_voids},
      {"largest_void", nullptr}};
  if (largest.cells > 0)
    json["largest_void"] = {{"area", static_cast<double>(largest.cells) * of_cell}, {"x", largest.x}, {"y", largest.y}};
  return json;
}

}  // namespace albtpu::quality
