// Check points as surveyors deliver them: a CSV file with the columns x, y and elevation, perhaps with more.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::quality {

// One standard deviation of check points, m: radial of their place, and of their elevation.
struct PointSigma {
  double horizontal = 0, vertical = 0;
};

struct CheckPoint {
  std::string id;        // Of its column; without one, "line 7" of the file.
  std::string kind;      // Of the column class; may be empty.
  double x = 0, y = 0;   // Units of the map.
  double elevation = 0;  // m, upwards
  PointSigma sigma = {};
};

struct CheckPointList {
  std::vector<CheckPoint> points;  // One at least.
  bool has_classes = false;
  bool horizontal_stated = false, vertical_stated = false;  // Of all: by a column or a flag.
};

// Errors of all points, where no column has their own, m.
struct GivenSigma {
  std::optional<double> horizontal, vertical;
};

// The unit of x and y, and that of elevations: columns are in these, as the annotated files are.
struct CheckPointUnits {
  double metres_per_unit = 1, metres_per_height_unit = 1;
};

inline constexpr std::size_t kMostCheckPoints = 10'000;

// Names of columns, in any case: the first of each is what messages call it.
inline constexpr std::array<std::string_view, 3> kNamesOfX = {"x", "easting", "east"};
inline constexpr std::array<std::string_view, 3> kNamesOfY = {"y", "northing", "north"};
inline constexpr std::array<std::string_view, 3> kNamesOfElevation = {"elevation", "z", "height"};
inline constexpr std::array<std::string_view, 3> kNamesOfId = {"id", "name", "point"};
inline constexpr std::array<std::string_view, 2> kNamesOfClass = {"class", "type"};
inline constexpr std::array<std::string_view, 1> kNamesOfHorizontal = {"sigma_horizontal"};
inline constexpr std::array<std::string_view, 1> kNamesOfVertical = {"sigma_vertical"};

// InvalidArgument with line and column where a column is missing or occurs twice, or a cell is no number.
absl::StatusOr<CheckPointList> ReadCheckPoints(const std::filesystem::path& path, const CheckPointUnits& units,
                                               const GivenSigma& given);

}  // namespace albtpu::quality
