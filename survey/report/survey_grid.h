// Annotated points gathered in square cells, in memory that grows with the cells that have points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "absl/status/status.h"
#include "survey/report/annotated_points.h"
#include "survey/report/point_tally.h"

namespace albtpu::client {

// The points of a cell, and means over those with a number.
struct GridCell {
  std::uint32_t points = 0, with_number = 0;
  float depth = 0, thu = 0, tvu = 0;                          // m
  std::array<float, kVerticalShareNames.size()> shares = {};  // m^2, of the vertical variance.
  std::uint8_t worst_order =
      0;  // The least strict best order of a point: 1 to 5 (kS44Orders), 6: a point meets none.
};

class SurveyGrid {
 public:
  static constexpr int kTile = 64;                      // Cells along a side of a tile.
  static constexpr std::size_t kMostBytes = 300 << 20;  // Of tiles.
  static constexpr double kMostCells = 2e8;             // Of the rectangle around all points.

  // `cell` is the side of a cell in the units of the coordinates, above 0.
  SurveyGrid(double cell, Coverage coverage) : cell_(cell), coverage_(coverage) {}

  // ResourceExhausted when the rectangle would have more than kMostCells cells.
  absl::Status CheckExtent(double least_x, double greatest_x, double least_y, double greatest_y) const;

  // `best_order`: 0 none, otherwise 1 plus the strictest order met. Once status() is not OK, points are ignored.
  void Add(const AnnotatedPoint& point, std::uint8_t best_order);

  // ResourceExhausted when the cells with points need more than kMostBytes.
  const absl::Status& status() const { return status_; }

  double cell() const { return cell_; }
  bool empty() const { return tiles_.empty(); }
  // The least index of a column (x / cell, rounded down) and of a row, multiples of kTile, and their number. Of a grid
  // that is not empty.
  std::int64_t first_column() const { return least_column_ * kTile; }
  std::int64_t first_row() const { return least_row_ * kTile; }
  std::size_t columns() const {
    return static_cast<std::size_t>(greatest_column_ - least_column_ + 1) * kTile;
  }
  std::size_t rows() const { return static_cast<std::size_t>(greatest_row_ - least_row_ + 1) * kTile; }

  // The cells of kTile rows, from first_row() + kTile strip, into rows of columns() cells, the southern one first.
  void Strip(std::size_t strip, std::vector<GridCell>& cells) const;

 private:
  using Tile = std::array<GridCell, static_cast<std::size_t>(kTile) * kTile>;

  Tile* TileAt(std::int64_t column, std::int64_t row);

  double cell_;
  Coverage coverage_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Tile>> tiles_;
  std::int64_t least_column_ = 0, greatest_column_ = 0, least_row_ = 0, greatest_row_ = 0;  // Of tiles.
  std::uint64_t last_key_ = 0;
  Tile* last_ = nullptr;
  absl::Status status_;
};

}  // namespace albtpu::client
