// Whether check points lie on the surface of a survey as closely as its predicted uncertainty says: the second proof
// beside overlapping lines, and the one that sees what all lines share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "quality/annotated/annotated_points.h"
#include "quality/checkpoints/check_points_file.h"
#include "quality/checkpoints/difference_statistics.h"
#include "quality/checkpoints/surroundings.h"

namespace albtpu::quality {

// Some of the check points.
struct PointGroup {
  bool wet = true;
  std::string kind = {};                                          // Of by_class: empty where they have none.
  double from = 0, to = std::numeric_limits<double>::infinity();  // Of by_depth: m of water.
  DifferenceStatistics statistics = {};
};

struct PointCheck {
  std::string name;  // Of the file of check points.
  CheckPointList list = {};
  double radius = kDefaultRadius;             // m
  std::vector<SurfaceAtPoint> surfaces = {};  // Of the check points with points around.
  std::vector<Difference> differences = {};   // By surface.
  LeftOutPoints left_out = {};
  DifferenceStatistics all = {};
  std::vector<PointGroup> by_class = {}, by_depth = {};  // Wet first; of wet ones.

  std::size_t without_surface() const { return list.points.size() - surfaces.size(); }
};

inline constexpr std::size_t kFewestToTest = 5;    // Of fewer, the interval of a variance spans more than 1 to 5.
inline constexpr std::size_t kPointsOfAsprs = 30;  // ASPRS edition 2 asks for as many.

// Surfaces less the elevations of their check points.
std::vector<Difference> DifferencesOf(const std::vector<SurfaceAtPoint>& surfaces,
                                      const std::vector<CheckPoint>& points);

// FailedPrecondition where no check point has a surface, and where elevations are plainly in another unit or count
// downwards: why, and where the files are.
absl::StatusOr<PointCheck> CheckPointsOf(const std::vector<AnnotatedLasFile>& files,
                                         const std::filesystem::path& points, const GivenSigma& given,
                                         const SurroundingOptions& options);

// Whether scatter and offset are as predicted; nullopt of fewer points than kFewestToTest.
std::optional<bool> Agrees(const PointCheck& check);

// What to conclude, one line without its end.
std::string Conclusion(const PointCheck& check);

nlohmann::ordered_json PointCheckJson(const PointCheck& check);

// For the user, some lines.
std::string PointCheckText(const PointCheck& check);

// A line for each check point, those without a surface too.
std::string PointCheckCsv(const PointCheck& check);

}  // namespace albtpu::quality
