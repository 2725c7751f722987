#include "quality/surface/node.h"

#include <algorithm>
#include <cmath>

#include "quality/crosscheck/flight_lines.h"
#include "sea/angle.h"

namespace albtpu::quality {
namespace {

// The sea's share of the points of one pass, and of the whole error what is left without it.
struct PassSea {
  double of_point = 0, of_pairs = 0;  // Of the vertical error at a fixed place: one point; the sum over ordered pairs.
  Eigen::Matrix3d whole = Eigen::Matrix3d::Zero();  // Of a point's error.
};

// Of the points that are not dry, m from the first point.
std::vector<Eigen::Vector2d> PlacesOf(std::span<const SurfacePoint> points, double metres_per_unit) {
  std::vector<Eigen::Vector2d> places;
  for (const SurfacePoint& point : points)
    if (!point.dry())
      places.emplace_back((point.x - points.front().x) * metres_per_unit,
                          (point.y - points.front().y) * metres_per_unit);
  return places;
}

struct MeanBeam {
  double incidence = 0, azimuth = 0, footprint = 0, squared_depth = 0, sea = 0;

  explicit MeanBeam(std::span<const SurfacePoint> points) {
    double north = 0, east = 0, n = 0;
    for (const SurfacePoint& point : points) {
      if (point.dry()) continue;
      ++n;
      incidence += point.incidence;
      footprint += point.footprint;
      squared_depth += point.depth * point.depth;
      sea += point.sea;
      // Near nadir the azimuth matters little, and scatters.
      north += point.incidence * std::cos(RadiansOfDegrees(point.azimuth));
      east += point.incidence * std::sin(RadiansOfDegrees(point.azimuth));
    }
    n = std::max(n, 1.0);
    incidence /= n, footprint /= n, squared_depth /= n, sea /= n;
    azimuth = DegreesOfRadians(std::atan2(east, north));
  }
};

// Of the points that are not dry.
PassSea SeaOf(std::span<const SurfacePoint> points, const Eigen::Vector3d& g, const NodeSources& sources) {
  const MeanBeam beam(points);
  PassSea sea;
  if (!(beam.sea > 0)) return sea;
  const SeaOfPulses waves = sources.sea(points.front().source, beam.incidence, beam.azimuth, beam.footprint,
                                        PlacesOf(points, sources.metres_per_unit));
  const double of_slopes = beam.squared_depth * waves.pulse.errors(2, 2);
  const SeaParts parts = PartsOfSea(beam.sea, beam.squared_depth, waves);
  const double scale = of_slopes > 0 ? parts.slopes / of_slopes * beam.squared_depth : 0;
  sea.whole = scale * waves.pulse.errors;
  if (scale == 0) sea.whole(2, 2) = parts.slopes;  // Of beams that are not known: of each pulse alone.
  const Eigen::Vector3d by_height = waves.by_height / waves.by_height.z();
  sea.whole += parts.heights * by_height * by_height.transpose();
  sea.of_point = g.dot(sea.whole * g);
  sea.of_pairs = scale * g.dot(waves.pairs.errors * g);
  if (parts.heights > 0) {
    const double here = parts.heights * std::pow(HeightsOnSlope(g, waves), 2);
    sea.of_pairs += here * waves.pairs.height / waves.pulse.height;
  }
  return sea;
}

}  // namespace

double NodeVariance::within_cell(std::size_t points) const {
  const auto n = static_cast<double>(points);
  return points > 1 ? n / (n - 1) * std::max(of_point - (apart_from_survey() - of_plane), 0.0) : 0;
}

NodeVariance VarianceOf(std::span<const SurfacePoint> points, const Eigen::Vector2d& slope, const NodeSources& sources,
                        std::vector<LineOfNode>* lines) {
  const Eigen::Vector3d g(-slope.x(), -slope.y(), 1);
  const auto n = static_cast<double>(points.size());
  NodeVariance variance;
  double of_line = 0, of_survey = 0;       // Sums of standard deviations.
  const SurfacePoint* of = points.data();  // The first point of the line.
  const auto end_line = [&](const SurfacePoint* next) {
    if (lines != nullptr) lines->push_back({.flight_line = of->flight_line, .time = of->time, .sigma = of_line / n});
    of = next;
    variance.line += of_line * of_line / (n * n);
    of_line = 0;
  };
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const SurfacePoint& first = points[begin];
    if (begin > 0 && (first.flight_line != points[begin - 1].flight_line ||
                      first.time - points[begin - 1].time > FlightLines::kPause))
      end_line(&first);
    for (end = begin + 1; end < points.size(); ++end) {
      const SurfacePoint& next = points[end];
      if (next.flight_line != first.flight_line || next.time - points[end - 1].time > kPassPause) break;
    }
    const std::span<const SurfacePoint> pass = points.subspan(begin, end - begin);
    const auto wet = static_cast<double>(pass.size() - std::ranges::count_if(pass, &SurfacePoint::dry));
    ++variance.passes;
    const PassSea sea = SeaOf(pass, g, sources);
    variance.sea += std::max(wet * sea.of_point + sea.of_pairs, 0.0) / (n * n);
    variance.of_point += wet / n * sea.of_point;

    for (const SurfacePoint& point : pass) {
      const HorizontalGroups groups = sources.groups(point.source);
      Eigen::Matrix3d rest;
      rest << point.xx, point.xy, point.xz, point.xy, point.yy, point.yz, point.xz, point.yz, 0;
      if (!point.dry()) rest -= sea.whole;
      rest(2, 2) = 0;
      const double by_slope = g.dot(rest * g);
      const auto with_slope = [&](double of_height, double fraction) {
        return std::max(of_height + fraction * by_slope, 0.0);
      };
      const double pulse = with_slope(point.pulse, groups.pulse), line = with_slope(point.line, groups.line);
      variance.pulse += pulse / (n * n);
      of_line += std::sqrt(line);
      of_survey += std::sqrt(with_slope(point.survey, groups.survey));
      variance.of_point += (pulse + line) / n;
    }
  }
  end_line(nullptr);
  variance.survey = of_survey * of_survey / (n * n);
  return variance;
}

}  // namespace albtpu::quality
