#include "quality/report/grid_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "annotate/answers/batch.h"
#include "grids/netcdf_grid.h"

namespace albtpu::quality {
namespace {

// One variable of the grid: its values of a cell.
struct Layer {
  const char *name, *long_name;
  const char* unit;
  float (*value)(const GridCell& cell);
};

template <std::size_t share>
float ShareOf(const GridCell& cell) {
  float total = 0;
  for (const float each : cell.shares) total += each;
  return total > 0 ? cell.shares[share] / total : 0;
}

constexpr std::array kLayers = {
    Layer{"elevation", "mean elevation of the bottom in the vertical datum of the files", "m",
          [](const GridCell& c) { return c.elevation; }},
    Layer{"depth", "mean depth of the bottom below the water surface at the time of the flight", "m",
          [](const GridCell& c) { return c.depth; }},
    Layer{"thu", "mean total horizontal uncertainty", "m", [](const GridCell& c) { return c.thu; }},
    Layer{"tvu", "mean total vertical uncertainty", "m", [](const GridCell& c) { return c.tvu; }},
    Layer{"share_air", "contribution of sensor and trajectory to the vertical variance", "1", ShareOf<0>},
    Layer{"share_sea", "contribution of the sea surface to the vertical variance", "1", ShareOf<1>},
    Layer{"share_water", "contribution of the water column to the vertical variance", "1", ShareOf<2>},
    Layer{"share_datum", "contribution of the vertical datum to the vertical variance", "1", ShareOf<3>},
    Layer{"share_extra", "contribution of what the surveyor added to the vertical variance", "1", ShareOf<4>}};

std::uint8_t DominantShare(const GridCell& cell) {
  return static_cast<std::uint8_t>(std::ranges::max_element(cell.shares) - cell.shares.begin() + 1);
}

}  // namespace

absl::Status WriteGrid(const SurveyGrid& grid, const GridFileFacts& facts, const std::filesystem::path& path) {
  const std::size_t rows = grid.rows(), columns = grid.columns();
  NetcdfGrid file(path,
                  {.first_column = grid.first_column(),
                   .first_row = grid.first_row(),
                   .columns = columns,
                   .rows = rows,
                   .cell = grid.cell(),
                   .crs_name = facts.crs_name,
                   .crs_wkt = facts.crs_wkt,
                   .vertical_name = facts.vertical_name,
                   .vertical_wkt = facts.vertical_wkt,
                   .metres_per_unit = facts.metres_per_unit},
                  SurveyGrid::kTile, "Depth and total propagated uncertainty of a survey by airborne lidar bathymetry");
  file.Text(NC_GLOBAL, "coverage", annotate::CoverageName(facts.coverage));
  std::array<int, kLayers.size()> layers = {};
  for (std::size_t k = 0; k < kLayers.size(); ++k)
    layers[k] = file.Floats(kLayers[k].name, kLayers[k].long_name, kLayers[k].unit);
  for (const std::size_t k : {2, 3}) file.Text(layers[k], "coverage", annotate::CoverageText(facts.coverage));
  file.Text(layers[0], "vertical_datum", facts.vertical_name.empty() ? "not stated" : facts.vertical_name);
  file.Text(layers[1], "vertical_datum", "water surface at the time of the flight");
  const int points = file.Counts("points", "points of the bottom");
  const int without = file.Counts("points_without_number", "points of the bottom without an uncertainty");
  const int order = file.Codes("order_met", "order of IHO S-44 that every point with a number meets", 6,
                               "exclusive special order_1a order_1b order_2 none");
  const int dominant = file.Codes("dominant_share", "largest contribution to the vertical variance",
                                  static_cast<std::uint8_t>(kVerticalShareNames.size()), "air sea water datum extra");
  const int gap =
      file.Codes("gap", "why points have no uncertainty, the most severe reason", 5,
                 "above_the_water outside_the_table_or_no_sea_or_water no_water_surface no_trajectory no_channel");
  file.EndDefinitions();

  std::vector<GridCell> cells;
  const std::size_t strips = rows / SurveyGrid::kTile;
  for (std::size_t strip = strips; strip-- > 0 && file.ok();) {
    grid.Strip(strip, cells);
    for (std::size_t south = 0, north = SurveyGrid::kTile - 1; south < north; ++south, --north)
      std::swap_ranges(cells.begin() + static_cast<std::ptrdiff_t>(south * columns),
                       cells.begin() + static_cast<std::ptrdiff_t>((south + 1) * columns),
                       cells.begin() + static_cast<std::ptrdiff_t>(north * columns));
    const std::size_t row = (strips - 1 - strip) * SurveyGrid::kTile;
    const auto put = [&](int variable, auto none, auto value) {
      std::vector<decltype(none)> values(cells.size(), none);
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].with_number > 0) values[i] = value(cells[i]);
      file.Put(variable, row, 0, columns, values);
    };
    for (std::size_t k = 0; k < kLayers.size(); ++k) put(layers[k], NetcdfGrid::kNoValue, kLayers[k].value);
    put(order, NetcdfGrid::kNoCode, [](const GridCell& cell) { return static_cast<std::uint8_t>(cell.worst_order); });
    put(dominant, NetcdfGrid::kNoCode, DominantShare);
    std::vector<std::uint8_t> gaps(cells.size());
    std::ranges::transform(cells, gaps.begin(), [](const GridCell& cell) { return cell.gap; });
    file.Put(gap, row, 0, columns, gaps);
    std::vector<int> all(cells.size()), no_number(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      all[i] = static_cast<int>(cells[i].points);
      no_number[i] = static_cast<int>(cells[i].points - cells[i].with_number);
    }
    file.Put(points, row, 0, columns, all);
    file.Put(without, row, 0, columns, no_number);
  }
  return file.Close();
}

}  // namespace albtpu::quality
