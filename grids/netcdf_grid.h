// A grid as a CF NetCDF-4 file, which GDAL, QGIS and xarray read: its place on the map, and variables of (y, x).
#pragma once

#include <netcdf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"

namespace albtpu {

// The grid has columns from `first_column` on, which counts cells from x = 0, and rows from `first_row` on, from y = 0.
struct GridFrame {
  std::int64_t first_column = 0, first_row = 0;
  std::size_t columns = 0, rows = 0;
  double cell = 1;                          // The side of a cell in the units of the map.
  std::string crs_name, crs_wkt;            // The second is empty if it is not known.
  std::string vertical_name, vertical_wkt;  // Of heights in metres; empty if it is not known.
  double metres_per_unit = 1;
};

// A file that is being written; rows begin in the north. After the first failure, calls do nothing, and Close() says
// why. A file that was not closed is removed.
//
//     NetcdfGrid file("grid.nc", frame, 64, "Depths of a survey");
//     const int depth = file.Floats("depth", "mean depth", "m");
//     file.EndDefinitions();
//     file.Put(depth, 0, 0, frame.columns, values);
//     RETURN_IF_ERROR(file.Close());
class NetcdfGrid {
 public:
  static constexpr float kNoValue = NC_FILL_FLOAT;
  static constexpr std::uint8_t kNoCode = 0;

  // `path` must be new. Variables are compressed in chunks of `tile` rows and 4 `tile` columns.
  NetcdfGrid(const std::filesystem::path& path, GridFrame frame, std::size_t tile, std::string_view title);
  ~NetcdfGrid();
  NetcdfGrid(const NetcdfGrid&) = delete;
  NetcdfGrid& operator=(const NetcdfGrid&) = delete;

  const GridFrame& frame() const { return frame_; }

  // Variables. Cells without a value have kNoValue or kNoCode; counts have 0.
  int Floats(const char* name, const char* long_name, const char* unit);
  int Counts(const char* name, const char* long_name);
  // Of codes from 1 to `count`, whose meanings are words separated by blanks.
  int Codes(const char* name, const char* long_name, std::uint8_t count, const char* meanings);
  // Of a variable, or of the file with NC_GLOBAL.
  void Text(int variable, const char* name, std::string_view text);
  void Number(int variable, const char* name, double value);

  void EndDefinitions();  // And writes the coordinates.

  // Values of whole rows of `columns` cells, from `row` (0: the northern one) and `column` on. `Value` is float, int or
  // std::uint8_t, as the variable is.
  template <typename Value>
  void Put(int variable, std::size_t row, std::size_t column, std::size_t columns, const std::vector<Value>& values) {
    const std::array<std::size_t, 2> start = {row, column}, count = {values.size() / columns, columns};
    if (ok()) Check(nc_put_vara(file_, variable, start.data(), count.data(), values.data()));
  }

  bool ok() const { return status_.ok(); }
  absl::Status Close();

 private:
  bool Check(int result);
  int Variable(const char* name, nc_type type, const std::vector<int>& dimensions);
  int OfCells(const char* name, const char* long_name, nc_type type);
  int Axis(const char* name, int dimension);
  void DescribeCrs(int crs);
  void DescribeTransverseMercator(int crs);

  std::filesystem::path path_;
  GridFrame frame_;
  std::size_t tile_;
  int file_ = 0, y_ = -1, x_ = -1, ys_ = -1, xs_ = -1;
  bool open_ = false;
  absl::Status status_;
};

}  // namespace albtpu
