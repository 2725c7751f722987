#include "quality/checkpoints/point_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/crs/foot.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

using formats::kMetresOfFoot;
constexpr double kPlain = 2, kMuchNearer = 0.1;  // m; of what elevations differ by as they are.

Difference DifferenceAt(const SurfaceAtPoint& surface, const CheckPoint& point) {
  const SurfaceNode& node = surface.node;
  const double slope = std::hypot(node.slope_x, node.slope_y);
  // A radial variance has a half along the slope.
  const double of_point = std::pow(point.sigma.vertical, 2) + std::pow(slope * point.sigma.horizontal, 2) / 2;
  Difference of{.difference = node.elevation - point.elevation,
                .bias = node.bias,
                .own = node.variance.pulse + node.variance.sea + of_point,
                .survey = std::sqrt(node.variance.survey),
                .tvu = surface.tvu,
                .point_sigma = point.sigma.vertical};
  for (const LineOfNode& line : surface.lines) of.lines.emplace_back(line.flight_line, line.sigma);
  return of;
}

double MedianSize(const PointCheck& check, const std::function<double(double)>& changed) {
  std::vector<double> sizes;
  for (const SurfaceAtPoint& each : check.surfaces)
    sizes.push_back(std::abs(each.node.elevation - changed(check.list.points[each.point].elevation)));
  return Median(std::move(sizes));
}

// Elevations that differ by metres, and do not once they are read otherwise.
absl::Status CheckElevations(const PointCheck& check, const AnnotatedLasFile& file) {
  const double as_given = MedianSize(check, [](double z) { return z; });
  if (as_given < kPlain) return absl::OkStatus();
  const bool metres = std::abs(file.metres_per_height_unit() - 1) < 1e-9;
  const double unit = file.metres_per_height_unit();
  struct Reading {
    const char* what;
    double factor;
  };
  std::vector<Reading> readings = {{"count downwards", -1}};
  if (metres)
    readings.push_back({"are feet", kMetresOfFoot}),
        readings.push_back({"are feet and count downwards", -kMetresOfFoot});
  else
    readings.push_back({"are metres", 1 / unit}), readings.push_back({"are metres and count downwards", -1 / unit});
  for (const Reading& reading : readings) {
    const double otherwise = MedianSize(check, [&](double z) { return z * reading.factor; });
    if (otherwise > kMuchNearer * as_given) continue;
    return absl::FailedPreconditionError(absl::StrFormat(
        "%s: its elevations seem to %s%s (they differ from the surface by %.2f m in the median, so read by %.2f m; "
        "heights of %s are in %s, upwards); give elevations in the unit and datum of the annotated files",
        check.name, reading.what[0] == 'a' ? "be " : "", reading.what[0] == 'a' ? reading.what + 4 : reading.what,
        as_given, otherwise, file.path().string(), metres ? "metres" : absl::StrFormat("units of %.10g m", unit)));
  }
  return absl::OkStatus();
}

std::string BoxText(const PlaneBox& box) {
  return absl::StrFormat("x from %.2f to %.2f, y from %.2f to %.2f", box.west, box.east, box.south, box.north);
}

absl::Status NoSurface(const PointCheck& check, const PlaneBox& box, const AnnotatedLasFile& file) {
  const std::vector<CheckPoint>& points = check.list.points;
  const auto inside = [&](const std::function<std::pair<double, double>(const CheckPoint&)>& at) {
    return std::ranges::any_of(points, [&](const CheckPoint& point) {
      const auto [x, y] = at(point);
      return box.Has(x, y);
    });
  };
  if (box.empty())
    return absl::FailedPreconditionError(
        absl::StrCat(file.path().string(),
                     ": no point of the bottom or of the ground has an uncertainty; annotate the "
                     "files with --details and a sensor"));
  if (inside([](const CheckPoint& p) { return std::pair(p.x, p.y); }))
    return absl::FailedPreconditionError(absl::StrFormat(
        "%s: no check point has %d points of the bottom or of the ground within %g m; give a larger --radius, or check "
        "points where the survey has points (%s)",
        check.name, kFewestPoints, check.radius, BoxText(box)));
  std::string why;
  PlaneBox of_points;
  for (const CheckPoint& point : points) of_points.Add(point.x, point.y);
  if (inside([](const CheckPoint& p) { return std::pair(p.y, p.x); }))
    why = "; x and y seem to be exchanged";
  else if (inside([](const CheckPoint& p) { return std::pair(p.x * kMetresOfFoot, p.y * kMetresOfFoot); }))
    why = "; they seem to be in feet, and the files are not";
  else if (inside([](const CheckPoint& p) { return std::pair(p.x / kMetresOfFoot, p.y / kMetresOfFoot); }))
    why = "; they seem to be in metres, and the files are not";
  return absl::FailedPreconditionError(absl::StrCat(
      check.name, ": all check points lie outside of the survey (", BoxText(of_points), "; the annotated points have ",
      BoxText(box), ", ", file.crs_name(), ")", why, "; give them in the coordinate system of the annotated files"));
}

void AddGroups(PointCheck& check) {
  std::map<std::pair<bool, std::string>, std::vector<std::size_t>> of_class;  // Wet ones first.
  constexpr std::array<double, 9> kDepths = {0, 2, 5, 10, 15, 20, 30, 50, std::numeric_limits<double>::infinity()};
  std::array<std::vector<std::size_t>, kDepths.size() - 1> of_depth;
  std::vector<std::size_t> all(check.surfaces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (const std::size_t i : all) {
    const SurfaceAtPoint& surface = check.surfaces[i];
    of_class[{!surface.wet, check.list.points[surface.point].kind}].push_back(i);
    if (!surface.wet) continue;
    const auto above = std::ranges::upper_bound(kDepths, std::max(0.0, double{surface.node.depth}));
    of_depth[static_cast<std::size_t>(above - kDepths.begin()) - 1].push_back(i);
  }
  check.all = StatisticsOf(check.differences, all);
  for (const auto& [key, taken] : of_class)
    check.by_class.push_back(
        {.wet = !key.first, .kind = key.second, .statistics = StatisticsOf(check.differences, taken)});
  for (std::size_t i = 0; i < of_depth.size(); ++i)
    if (!of_depth[i].empty())
      check.by_depth.push_back(
          {.from = kDepths[i], .to = kDepths[i + 1], .statistics = StatisticsOf(check.differences, of_depth[i])});
}

}  // namespace

std::vector<Difference> DifferencesOf(const std::vector<SurfaceAtPoint>& surfaces,
                                      const std::vector<CheckPoint>& points) {
  std::vector<Difference> differences;
  for (const SurfaceAtPoint& each : surfaces) differences.push_back(DifferenceAt(each, points[each.point]));
  const auto of_lidar = [&](std::size_t i) { return surfaces[i].node.variance.pulse + surfaces[i].node.variance.sea; };
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (const auto& [other, correlation] : surfaces[i].shared)
      differences[i].same_points.emplace_back(other, correlation * std::sqrt(of_lidar(i) * of_lidar(other)));
  return differences;
}

absl::StatusOr<PointCheck> CheckPointsOf(const std::vector<AnnotatedLasFile>& files,
                                         const std::filesystem::path& points, const GivenSigma& given,
                                         const SurroundingOptions& options) {
  const AnnotatedLasFile& first = files.front();
  for (const AnnotatedLasFile& file : files)
    if (file.metres_per_height_unit() != first.metres_per_height_unit())
      return absl::InvalidArgumentError(absl::StrFormat(
          "%s: the unit of its heights is %.10g m (in %s it is %.10g m); check files of each unit apart",
          file.path().string(), file.metres_per_height_unit(), first.path().string(), first.metres_per_height_unit()));
  PointCheck check{.name = points.string(), .radius = options.radius};
  const CheckPointUnits units = {first.metres_per_unit(), first.metres_per_height_unit()};
  ASSIGN_OR_RETURN(check.list, ReadCheckPoints(points, units, given));
  ASSIGN_OR_RETURN(Surroundings around, SurroundingsOf(files, check.list.points, options));
  check.surfaces = std::move(around.surfaces);
  check.left_out = around.left_out;
  if (check.surfaces.empty()) return NoSurface(check, around.box, first);
  RETURN_IF_ERROR(CheckElevations(check, first));
  check.differences = DifferencesOf(check.surfaces, check.list.points);
  AddGroups(check);
  return check;
}

}  // namespace albtpu::quality
