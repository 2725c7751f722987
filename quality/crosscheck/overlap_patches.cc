#include "quality/crosscheck/overlap_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sea/angle.h"
#include "sea/samples.h"

namespace albtpu::quality {
namespace {

constexpr double kGreatestIndex = 2e9;  // Of a patch: so that two fit 64 bits.

std::uint64_t Pack(std::int32_t column, std::int32_t row) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 | static_cast<std::uint32_t>(row);
}

}  // namespace

std::uint64_t OverlapPatches::KeyOf(const AnnotatedPoint& point) const {
  if (!point.has_number) return 0;
  const double column = std::floor(point.x * metres_per_unit_ / side_);
  const double row = std::floor(point.y * metres_per_unit_ / side_);
  if (!(std::abs(column) < kGreatestIndex && std::abs(row) < kGreatestIndex)) return 0;
  const std::uint64_t key = Pack(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  return (MixBits(key) & mask_) == 0 ? key : 0;
}

void OverlapPatches::Find(std::span<const AnnotatedPoint> points) {
  for (const AnnotatedPoint& point : points) {
    times_.Add(point.line, point.time);
    const std::uint64_t key = KeyOf(point);
    if (key == 0) continue;
    Known& known = known_[key];
    const auto id = static_cast<std::uint16_t>(point.line);
    if (known.points == 0) known.first_id = id;
    known.overlap |= known.first_id != id;
    if (known.first_id == id && std::isfinite(point.time) && point.time != 0) {
      known.first_time = std::min(known.first_time, point.time);
      known.last_time = std::max(known.last_time, point.time);
    }
    ++known.points;
    if (known_.size() > kMaxKnown) Thin();
  }
}

void OverlapPatches::Thin() {
  mask_ = mask_ << 1 | 1;
  std::erase_if(known_, [this](const auto& each) { return (MixBits(each.first) & mask_) != 0; });
  std::erase_if(chosen_, [this](const auto& each) { return (MixBits(each.first) & mask_) != 0; });
}

void OverlapPatches::Choose() {
  lines_ = FlightLines(times_);
  times_ = LineTimes();
  std::erase_if(known_, [this](const auto& each) {
    const Known& known = each.second;
    return !known.overlap &&
           lines_.NumberOf(known.first_id, known.first_time) == lines_.NumberOf(known.first_id, known.last_time);
  });
  const auto points = [this] {
    std::size_t sum = 0;
    for (const auto& [key, known] : known_) sum += known.points;
    return sum;
  };
  while (points() > kMostPoints) Thin();
  chosen_.reserve(known_.size());
  for (const auto& [key, known] : known_) chosen_.emplace(key, UINT32_MAX);
  known_ = {};
}

void OverlapPatches::Fill(std::span<const AnnotatedPoint> points, std::uint16_t of_sea) {
  const double factor = VerticalFactor(coverage_);
  const auto variance = [factor](float tvu) { return std::pow(tvu / factor, 2); };
  for (const AnnotatedPoint& point : points) {
    const std::uint64_t key = KeyOf(point);
    const auto found = key == 0 ? chosen_.end() : chosen_.find(key);
    if (found == chosen_.end()) continue;
    const std::optional<std::uint16_t> line = lines_.NumberOf(point.line, point.time);
    if (!line.has_value()) continue;
    const double x = point.x * metres_per_unit_, y = point.y * metres_per_unit_;
    if (found->second == UINT32_MAX) {
      found->second = static_cast<std::uint32_t>(patches_.size());
      patches_.push_back({(std::floor(x / side_) + 0.5) * side_, (std::floor(y / side_) + 0.5) * side_, {}});
    }
    Patch& patch = patches_[found->second];
    const double sea = variance(point.tvu_sea);
    const double of_line = variance(point.tvu_line), own = variance(point.tvu_pulse) + of_line;
    const double air = std::max(variance(point.tvu_pulse) - sea, 0.0);
    // A point has the horizontal entries of the total alone. Nearly all of them belong to pulse and line: the errors
    // common to a survey are mostly vertical. The correlations are those of the total.
    const float of_height =
        point.variance_z > 0 ? static_cast<float>(std::sqrt(std::min(own / point.variance_z, 1.0))) : 0;
    const double sea_in_horizontal = point.thu > 0 ? std::min(std::pow(point.thu_sea / point.thu, 2), 1.0) : 0;
    const double azimuth = RadiansOfDegrees(point.beam_azimuth);
    const bool known = std::isfinite(azimuth);
    const double east = known ? point.bias_along_beam * std::sin(azimuth) : 0;
    const double north = known ? point.bias_along_beam * std::cos(azimuth) : 0;
    patch.points.push_back({.x = static_cast<float>(x - east - patch.x),
                            .y = static_cast<float>(y - north - patch.y),
                            .z = static_cast<float>(point.z - point.bias_vertical),
                            .variance_air = static_cast<float>(air),
                            .variance_sea = static_cast<float>(sea),
                            .variance_line = static_cast<float>(of_line),
                            .xx = point.variance_x,
                            .yy = point.variance_y,
                            .xy = point.covariance_xy,
                            .xz = of_height * point.covariance_xz,
                            .yz = of_height * point.covariance_yz,
                            .sea_in_horizontal = static_cast<float>(sea_in_horizontal),
                            .depth = point.depth,
                            .incidence = point.incidence,
                            .azimuth = point.beam_azimuth,
                            .footprint = point.footprint,
                            .time = point.time,
                            .line = *line,
                            .sea = of_sea});
  }
}

namespace {

using Line = std::span<const PatchPoint>;

struct Slope {
  double x = 0, y = 0;            // m in a metre.
  double xx = 0, yy = 0, xy = 0;  // Their covariance.
};

// The common slope of the lines: least squares of what is left of x, y and z without the means of each line.
std::optional<Slope> FitSlope(const std::vector<Line>& lines) {
  double sxx = 0, syy = 0, sxy = 0, sxz = 0, syz = 0, szz = 0;
  std::size_t count = 0;
  for (const Line& line : lines) {
    const auto n = static_cast<double>(line.size());
    double mx = 0, my = 0, mz = 0;
    for (const PatchPoint& point : line) mx += point.x / n, my += point.y / n, mz += point.z / n;
    for (const PatchPoint& point : line) {
      const double x = point.x - mx, y = point.y - my, z = point.z - mz;
      sxx += x * x, syy += y * y, sxy += x * y, sxz += x * z, syz += y * z, szz += z * z;
    }
    count += line.size();
  }
  const double determinant = sxx * syy - sxy * sxy;
  const std::size_t unknowns = lines.size() + 2;
  // Points nearly in one straight line do not determine the slope across it.
  if (count <= unknowns || !(determinant > 1e-3 * sxx * syy)) return std::nullopt;
  Slope slope;
  slope.x = (syy * sxz - sxy * syz) / determinant;
  slope.y = (sxx * syz - sxy * sxz) / determinant;
  const double left = std::max(szz - slope.x * sxz - slope.y * syz, 0.0) / static_cast<double>(count - unknowns);
  slope.xx = left * syy / determinant;
  slope.yy = left * sxx / determinant;
  slope.xy = -left * sxy / determinant;
  return slope;
}

PointOfBeam BeamOf(const Patch& patch, const PatchPoint& point) {
  return {.x = patch.x + double{point.x},
          .y = patch.y + double{point.y},
          .depth = point.depth,
          .incidence = point.incidence,
          .azimuth = point.azimuth,
          .footprint = point.footprint};
}

// Of the height of a point above a plane of this slope: g' C g with g = (-slope_x, -slope_y, 1), because a point that
// lies too far down the slope is too high above it. What is not of the sea is divided among air side and line as the
// variance of the height is.
PairedPoint AboveSlope(const PointOfBeam& beam, const PatchPoint& point, const Slope& slope, const SharedWaves& waves) {
  const double added = slope.x * slope.x * point.xx + slope.y * slope.y * point.yy + 2 * slope.x * slope.y * point.xy -
                       2 * (slope.x * point.xz + slope.y * point.yz);
  const double air = point.variance_air, sea = point.variance_sea, line = point.variance_line;
  PairedPoint above{.pulse = PulseOnWater::Of(beam, point.time, point.sea)};
  const SeaOfPulses of_sea = waves.At(beam, point.sea);
  const double on_slope = HeightsOnSlope({-slope.x, -slope.y, 1}, of_sea);
  const double heights = on_slope * on_slope * PartsOfSea(sea, beam.depth * beam.depth, of_sea).heights;
  const auto heights_in = [heights](double variance) { return static_cast<float>(std::min(heights, variance)); };
  if (added < 0) {
    const double level = air + sea + line, left = level > 0 ? std::max(1 + added / level, 0.0) : 0;
    above.variance_air = static_cast<float>(left * air);
    above.variance_sea = static_cast<float>(left * sea);
    above.variance_line = static_cast<float>(left * line);
    above.variance_heights = heights_in(left * sea);
    return above;
  }
  const double rest = (1 - point.sea_in_horizontal) * added, to_line = air + line > 0 ? line / (air + line) : 0;
  above.variance_air = static_cast<float>(air + (1 - to_line) * rest);
  above.variance_sea = static_cast<float>(sea + point.sea_in_horizontal * added);
  above.variance_line = static_cast<float>(line + to_line * rest);
  above.variance_heights = heights_in(above.variance_sea);
  return above;
}

// What pairs of a patch have in common.
struct Bottom {
  const Patch& patch;
  Slope slope;
  const SharedWaves& waves;
};

CrossPair PairOf(const Bottom& bottom, const PatchPoint& a, const PatchPoint& b) {
  const Slope& slope = bottom.slope;
  const double dx = a.x - b.x, dy = a.y - b.y;
  const double slope_error = slope.xx * dx * dx + slope.yy * dy * dy + 2 * slope.xy * dx * dy;
  return {.line_a = a.line,
          .line_b = b.line,
          .x = bottom.patch.x,
          .y = bottom.patch.y,
          .difference = static_cast<float>(a.z - b.z - slope.x * dx - slope.y * dy),
          .distance = static_cast<float>(std::hypot(dx, dy)),
          .variance_slope = static_cast<float>(slope_error),
          .depth = (a.depth + b.depth) / 2,
          .incidence = (a.incidence + b.incidence) / 2,
          .a = AboveSlope(BeamOf(bottom.patch, a), a, slope, bottom.waves),
          .b = AboveSlope(BeamOf(bottom.patch, b), b, slope, bottom.waves)};
}

// Null where there are none.
struct Nearest {
  const PatchPoint *a = nullptr, *b = nullptr;
  float squared = std::numeric_limits<float>::infinity();

  void Try(const PatchPoint& of_a, const PatchPoint& of_b) {
    const float dx = of_a.x - of_b.x, dy = of_a.y - of_b.y, square = dx * dx + dy * dy;
    if (square < squared) a = &of_a, b = &of_b, squared = square;
  }
};

Nearest NearestOf(const Line& a, const Line& b) {
  Nearest nearest;
  for (const PatchPoint& of_a : a)
    for (const PatchPoint& of_b : b) nearest.Try(of_a, of_b);
  return nearest;
}

Nearest NearestOf(const Line& line) {
  Nearest nearest;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (std::size_t j = i + 1; j < line.size(); ++j)
      if (!(std::abs(line[i].time - line[j].time) > SharedWaves::kPause)) nearest.Try(line[i], line[j]);
  return nearest;
}

}  // namespace

void AppendPairs(Patch& patch, const SharedWaves& waves, PatchPairs& pairs) {
  std::ranges::stable_sort(patch.points, {}, &PatchPoint::line);
  std::vector<Line> lines;
  for (std::size_t begin = 0; begin < patch.points.size();) {
    std::size_t end = begin + 1;
    while (end < patch.points.size() && patch.points[end].line == patch.points[begin].line) ++end;
    if (end - begin >= kMinPoints) lines.push_back(Line(patch.points).subspan(begin, end - begin));
    begin = end;
  }
  if (lines.size() < 2) return;
  const std::optional<Slope> slope = FitSlope(lines);
  if (!slope.has_value()) return;
  const Bottom bottom = {patch, *slope, waves};
  const auto append = [&](const Nearest& nearest, std::vector<CrossPair>& list) {
    if (nearest.a == nullptr) return;
    const CrossPair pair = PairOf(bottom, *nearest.a, *nearest.b);
    if (pair.variance_air() + pair.variance_sea() > 0) list.push_back(pair);
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    append(NearestOf(lines[i]), pairs.within);
    for (std::size_t j = i + 1; j < lines.size(); ++j) append(NearestOf(lines[i], lines[j]), pairs.across);
  }
}

}  // namespace albtpu::quality
