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
#include "quality/annotated/annotated_points.h"
#include "quality/report/point_tally.h"

namespace albtpu::quality {

// The points of a cell, and means over those with a number. 36 bytes: a survey has tens of millions of cells.
struct GridCell {
  std::uint32_t gap : 3 = 0;  // The most severe Gap of its points.
  std::uint32_t points : 29 = 0;
  // The least strict best order of a point: 1 to 5 (kS44Orders), 6: a point meets none; 0 without a number.
  std::uint32_t worst_order : 3 = 0;
  std::uint32_t with_number : 29 = 0;
  float depth = 0, thu = 0, tvu = 0;                          // m
  std::array<float, kVerticalShareNames.size()> shares = {};  // m^2, of the vertical variance.
};
static_assert(sizeof(GridCell) == 36);

class SurveyGrid {
 public:
  static constexpr int kTile = 64;                      // Cells along a side of a tile.
  static constexpr std::size_t kMostBytes = 400 << 20;  // Of cells with points.
  static constexpr double kMaxCells = 2e8;              // Of the rectangle around all points.

  // `cell` is the side of a cell in the units of the coordinates, above 0.
  SurveyGrid(double cell, Coverage coverage) : cell_(cell), coverage_(coverage) {}

  // ResourceExhausted when the rectangle would have more than kMaxCells cells.
  absl::Status CheckExtent(double min_x, double max_x, double min_y, double max_y) const;

  // `best_order`: 0 none, otherwise 1 plus the strictest order met. Once status() is not OK, points are ignored.
  void Add(const AnnotatedPoint& point, std::uint8_t best_order);

  // ResourceExhausted when the cells with points need more than kMostBytes.
  const absl::Status& status() const { return status_; }

  double cell() const { return cell_; }
  bool empty() const { return tiles_.empty(); }
  // The smallest index of a column (x / cell, rounded down) and of a row, multiples of kTile, and their number. Of a
  // grid that is not empty.
  std::int64_t first_column() const { return min_column_ * kTile; }
  std::int64_t first_row() const { return min_row_ * kTile; }
  std::size_t columns() const { return static_cast<std::size_t>(max_column_ - min_column_ + 1) * kTile; }
  std::size_t rows() const { return static_cast<std::size_t>(max_row_ - min_row_ + 1) * kTile; }

  // The cells of kTile rows, from first_row() + kTile strip, into rows of columns() cells, the southern one first.
  void Strip(std::size_t strip, std::vector<GridCell>& cells) const;

 private:
  // kTile by kTile cells, of which those without points take two bytes: lines leave gaps between their points.
  class Tile {
   public:
    static constexpr std::size_t kCells = static_cast<std::size_t>(kTile) * kTile, kBlock = 64;
    using Block = std::array<GridCell, kBlock>;

    const GridCell* Find(std::size_t cell) const {  // Null: it has no points.
      return places_[cell] == 0 ? nullptr : &At(places_[cell] - 1U);
    }
    GridCell& At(std::size_t place) const { return (*blocks_[place / kBlock])[place % kBlock]; }
    std::size_t PlaceOf(std::size_t cell);  // Makes one where there is none.
    std::size_t blocks() const { return blocks_.size(); }

   private:
    std::array<std::uint16_t, kCells> places_ = {};  // Plus 1, in the order of the first points.
    std::uint16_t used_ = 0;
    std::vector<std::unique_ptr<Block>> blocks_;
  };

  Tile* TileAt(std::int64_t column, std::int64_t row);

  double cell_;
  Coverage coverage_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Tile>> tiles_;
  std::int64_t min_column_ = 0, max_column_ = 0, min_row_ = 0, max_row_ = 0;  // Of tiles.
  std::uint64_t last_key_ = 0;
  Tile* last_ = nullptr;
  std::size_t bytes_ = 0;  // Of tiles and their blocks.
  absl::Status status_;
};

}  // namespace albtpu::quality
