// A grid as a CF NetCDF-4 file, which GDAL, QGIS and xarray read.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/status.h"
#include "quality/report/survey_grid.h"
#include "tables/coverage.h"

namespace albtpu::quality {

struct GridFileFacts {
  Coverage coverage = Coverage::kTwoSigma;
  std::string crs_name, crs_wkt;            // The second is empty if it is not known.
  std::string vertical_name, vertical_wkt;  // Of elevations; empty if not stated.
  double metres_per_unit = 1;
};

// Writes `grid`, which has points, to `path`, which must be new. Rows begin in the north. Variables of (y, x):
//
//   elevation depth thu tvu                     float, m, means of the points with a number
//   share_air share_sea share_water share_datum share_extra float, of the vertical variance, 0 to 1
//   points points_without_number                int
//   order_met                                   byte, S-44: the least strict order among the best ones of the points
//   dominant_share                              byte
//   gap                                         byte, why points have no number: the most severe Gap
//
// Values of cells without a number are the fill value; counts are 0. `gap` has values where points have no number.
absl::Status WriteGrid(const SurveyGrid& grid, const GridFileFacts& facts, const std::filesystem::path& path);

}  // namespace albtpu::quality
