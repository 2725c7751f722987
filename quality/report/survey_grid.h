// Annotated points gathered in square cells, in memory that grows with the cells that have points, and the statistics
// of the points by class of each specification and by depth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <unordered_map>
#include <vector>

#include "absl/status/status.h"
#include "annotate/totals/total_summary.h"
#include "quality/annotated/annotated_points.h"
#include "quality/report/specification.h"

namespace albtpu::quality {

// Statistics of many annotated points: THU and TVU, the contributions to the variance, and how many meet each class of
// each specification.

// Which classes a point meets.
class ClassJudge {
 public:
  static constexpr std::size_t kMaxClasses = 64;

  // `specifications` must outlive it and have at most kMaxClasses classes in all.
  explicit ClassJudge(const std::vector<Specification>& specifications);

  // Bit c: the point meets class c, counted over all specifications in their order. A class is met where the
  // uncertainty at its coverage plus the magnitude of the bias is within each of its limits: U = k sigma + |b|, JCGM
  // 100:2008, F.2.4.5. None without a number.
  std::uint64_t Met(const AnnotatedPoint& point) const;

  // By which factor all standard deviations of a point may be multiplied until it is at the first limit of class c; 0
  // where its bias alone is beyond one. `point` has a number.
  double Margin(const AnnotatedPoint& point, std::size_t c) const;

 private:
  std::vector<SpecificationClass> classes_;
};

// The contributions to the vertical variance of points.
enum class VerticalShare : std::uint8_t { kAir, kSea, kWater, kDatum, kExtra };
inline constexpr std::array<const char*, 5> kVerticalShareNames = {"air", "sea", "water", "datum", "extra"};

// m^2 at 1 sigma, by VerticalShare; the datum is the rest of the total. `point` has a number.
std::array<double, kVerticalShareNames.size()> VerticalShares(const AnnotatedPoint& point, Coverage coverage);

class PointTally {
 public:
  // `met` is ClassJudge::Met.
  void Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage);
  void Merge(const PointTally& other);

  std::uint64_t points() const { return points_; }
  std::uint64_t with_number() const { return thu_.count(); }
  std::uint64_t meeting(std::size_t of_class) const { return met_[of_class]; }

  // points, with_number; if there are any with a number thu, tvu (mean, median, p95, greatest), bias_along_beam and
  // bias_vertical (means), elevation (mean, least, greatest), shares_vertical and groups_vertical (fractions); meeting
  // (of `classes` classes).
  nlohmann::ordered_json Json(std::size_t classes) const;

 private:
  std::uint64_t points_ = 0;
  annotate::LengthSpread thu_, tvu_;
  std::array<double, kVerticalShareNames.size()> shares_ = {};                                    // Sums, m^2.
  double pulse_ = 0, line_ = 0;                                                                   // Sums, m^2.
  double bias_along_beam_ = 0, bias_vertical_ = 0;                                                // Sums, m.
  double elevation_ = 0, lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;  // m
  std::array<std::uint64_t, ClassJudge::kMaxClasses> met_ = {};
};

// Points of each metre of depth, the last without an end.
class DepthTallies {
 public:
  void Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage);  // With a number.

  // A list: from, to (null of the last), and PointTally::Json; bins without points are left out. Bins are as wide as
  // the ends in `ends` say, whole metres that rise; empty: a metre.
  nlohmann::ordered_json Json(std::size_t classes, const std::vector<int>& ends = {}) const;

 private:
  static constexpr int kBins = 100;
  std::vector<PointTally> bins_ = std::vector<PointTally>(kBins);
};

// The points of a cell, and means over those with a number. 44 bytes: a survey has tens of millions of cells.
struct GridCell {
  std::uint32_t gap : 3 = 0;  // The most severe Gap of its points.
  std::uint32_t points : 29 = 0;
  // The least strict best order of a point: 1 to 5 (kS44Orders), 6: a point meets none; 0 without a number.
  std::uint32_t worst_order : 3 = 0;
  std::uint32_t with_number : 29 = 0;
  float elevation = 0, depth = 0, thu = 0, tvu = 0;           // m
  std::array<float, kVerticalShareNames.size()> shares = {};  // m^2, of the vertical variance.
};
static_assert(sizeof(GridCell) == 44);

class SurveyGrid {
 public:
  static constexpr int kTile = 64;                      // Cells along a side of a tile.
  static constexpr std::size_t kMostBytes = 400 << 20;  // Of cells with points.
  static constexpr double kMaxCells = 2.2e8;            // Of the tiles in the rectangle around all points.

  // `cell` is the side of a cell in the units of the coordinates, above 0.
  SurveyGrid(double cell, Coverage coverage) : cell_(cell), coverage_(coverage) {}

  // `best_order`: 0 none, otherwise 1 plus the strictest order met. Once status() is not OK, points are ignored.
  void Add(const AnnotatedPoint& point, std::uint8_t best_order);

  // ResourceExhausted when the cells with points need more than kMostBytes, or the rectangle has more than kMaxCells.
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

    double base = 0;  // m; elevations of cells are above it: a float holds a height of 4000 m to 0.2 mm alone.

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
