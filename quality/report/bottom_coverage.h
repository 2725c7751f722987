// How densely points of the bottom lie, and where they leave voids: what files can show of the coverage of a survey.
#pragma once

#include <bitset>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <unordered_map>

#include "quality/annotated/annotated_points.h"
#include "quality/report/survey_grid.h"

namespace albtpu::quality {

// The cells of a grid that have dry land, which is no void.
class LandCells {
 public:
  explicit LandCells(double cell) : cell_(cell) {}  // As that of the grid.
  void Add(const DryPoint& dry);
  bool Has(std::int64_t column, std::int64_t row) const;

 private:
  static constexpr int kTile = SurveyGrid::kTile;
  static constexpr std::size_t kMostTiles = 100'000;  // 60 MB; land beyond them counts as a void.
  using Tile = std::bitset<static_cast<std::size_t>(kTile) * kTile>;

  double cell_;
  std::unordered_map<std::uint64_t, Tile> tiles_;
  std::uint64_t last_key_ = 0;
  Tile* last_ = nullptr;
};

// A void: cells without a point of the bottom that adjoin by their sides.
struct BottomVoid {
  std::uint64_t cells = 0;
  double x = 0, y = 0;  // The middle of its longest row, in the unit of the grid.
};

// Points of the bottom in the surveyed area: all cells that have cells with points of the bottom to the west and to the
// east in their row, and to the north and to the south in their column, and those cells themselves, but for cells of
// land. That has no length to choose, and holds gaps between lines; a bay beyond the survey that it encloses from two
// sides is in it, too.
struct BottomCoverage {
  double cell = 0;                       // m
  std::uint64_t cells = 0, covered = 0;  // Of the surveyed area; with a point.
  std::uint64_t points = 0;
  std::uint64_t median = 0, least_but_5 = 0;  // Points of a covered cell: the median, and the 5th percentile.
  std::uint64_t voids = 0, large_voids = 0;   // Large: at least (4 spacing)^2.
  BottomVoid largest;

  double area() const { return static_cast<double>(cells) * cell * cell; }  // m^2
  double density() const { return static_cast<double>(points) / area(); }   // Points in a m^2.
  double spacing() const;                                                   // m, 1 / sqrt(density).

  // Of a grid with points. `metres_per_unit` is of its coordinates.
  static BottomCoverage Of(const SurveyGrid& grid, const LandCells& land, double metres_per_unit);
  nlohmann::ordered_json Json() const;
};

}  // namespace albtpu::quality
