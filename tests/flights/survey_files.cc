#include "tests/flights/survey_files.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr double kSecondsOfWeek = 604800;

// ASPRS, LAS Domain Profile for Topo-Bathy Lidar; for formats 0 to 5, whose classes end at 31, what NOAA's older files
// have.
int ClassOf(ReturnKind kind, int point_format) {
  constexpr int kClasses[] = {40, 41, 45, 2}, kLegacyClasses[] = {26, 27, 25, 2};
  return (point_format < 6 ? kLegacyClasses : kClasses)[static_cast<std::size_t>(kind)];
}

// OGC GeoTIFF 1.1: a projected (3072) or geographic (2048) system by its code; 4096 vertical system, 4099 unit of
// heights.
std::string GeoKeysOf(const MapGrid& grid, bool orthometric) {
  std::vector<std::pair<int, int>> keys = {{1024, 1}, {3072, grid.epsg}, {3076, grid.linear_unit}};
  if (grid.projection == nullptr) keys = {{1024, 2}, {2048, grid.epsg}};
  if (orthometric) keys.push_back({4096, 5703});
  keys.push_back({4099, grid.linear_unit});
  return GeoKeys(keys);
}

constexpr double kVelocitySigma = 0.005;  // m/s
constexpr double kArcMinute = kDegree / 60;

void Append(std::string& bytes, std::initializer_list<double> numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(double));
}

// In (-pi, pi].
double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// Calls visit(time of the week, state) at `rate`, without the gap. All times are multiples of the interval.
template <typename Visit>
void VisitRecords(const SimulatedSurvey& survey, const TrajectoryOptions& options, double rate, Visit visit) {
  for (std::size_t line = 0; line < survey.aircraft.size(); ++line) {
    const int last = static_cast<int>((survey.options.seconds + options.margin) * rate);
    for (int i = static_cast<int>(-options.margin * rate); i <= last; ++i) {
      const double since_start = i / rate;
      const bool in_gap = line == 0 && since_start > options.gap_start && since_start < options.gap_start + options.gap;
      if (in_gap) continue;
      visit(survey.LineStart(static_cast<int>(line)) + since_start + options.clock,
            survey.aircraft[line].At(since_start));
    }
  }
}

double Degrees(double azimuth) { return std::fmod(azimuth / kDegree + 360, 360); }

}  // namespace

LasSpec PointsOf(const SimulatedSurvey& survey, const std::vector<std::size_t>& returns, const PointOptions& options) {
  const MapGrid grid = *FindMapGrid(survey.options.grid);
  const bool orthometric = options.geoid_separation != 0;
  LasSpec spec;
  spec.version_minor = options.version_minor;
  spec.point_format = options.point_format;
  spec.scale = options.scale;
  spec.adjusted_time = options.adjusted_time;
  if (options.geotiff_keys)
    spec.vlrs.push_back({"LASF_Projection", 34735, GeoKeysOf(grid, orthometric)});
  else
    spec.vlrs.push_back({"LASF_Projection", 2112, grid.LasWkt(orthometric) + '\0'});
  // Offsets are round numbers. Degrees need a finer resolution than heights, but a record of the builder has one for
  // all; at 1e-8, heights reach 21 m from their offset. At 1e-7, longitudes reach 215 degrees.
  const bool degrees = grid.projection == nullptr;
  const GridPoint origin = grid.At(survey.options.latitude, survey.options.longitude);
  const double round = degrees ? 1 : 10000;
  const bool at_antimeridian = degrees && !grid.from_zero && std::abs(origin.x) > 179;
  if (degrees) spec.scale = at_antimeridian ? 1e-7 : 1e-8;
  const double mean_height = std::round(survey.options.water_level - options.geoid_separation - 7);
  spec.offset = {at_antimeridian ? 0 : round * std::floor(origin.x / round), round * std::floor(origin.y / round),
                 degrees ? mean_height : 0};
  const auto steps = [&](double value, std::size_t axis) {
    return static_cast<std::int32_t>(std::lround((value - spec.offset[axis]) / spec.scale));
  };
  const double time_zero = options.adjusted_time ? options.gps_week * kSecondsOfWeek - 1e9 : 0;
  spec.points.reserve(returns.size());
  for (const std::size_t index : returns) {
    const SimulatedReturn& found = survey.returns[index];
    const SimulatedPulse& pulse = survey.pulses[found.pulse];
    const GridPoint at = grid.At(found.position.latitude, found.position.longitude);
    const double time = options.adjusted_time ? pulse.time : std::fmod(pulse.time, kSecondsOfWeek);
    LasPoint point;
    point.x = steps(at.x, 0);
    point.y = steps(at.y, 1);
    point.z = steps((found.position.height - options.geoid_separation) / grid.metres_per_unit, 2);
    point.classification = ClassOf(found.kind, options.point_format);
    point.scan_angle = pulse.scan_angle / kDegree;
    point.gps_time = time_zero + time;
    point.point_source_id = options.no_source_id ? 0 : pulse.line;
    point.return_number = found.number;
    point.return_count = found.count;
    spec.points.push_back(point);
  }
  return spec;
}

std::string TruthOf(const SimulatedSurvey& survey, const std::vector<std::size_t>& returns,
                    const PointOptions& options) {
  const MapGrid grid = *FindMapGrid(survey.options.grid);
  std::string bytes;
  for (const std::size_t index : returns) {
    const SimulatedReturn& found = survey.returns[index];
    const SimulatedPulse& pulse = survey.pulses[found.pulse];
    const GridPoint sensor = grid.At(pulse.sensor.latitude, pulse.sensor.longitude);
    const double row[] = {pulse.time,
                          static_cast<double>(pulse.line),
                          static_cast<double>(found.pulse),
                          static_cast<double>(found.kind),
                          pulse.incidence / kDegree,
                          Degrees(pulse.azimuth),
                          pulse.slant_range * options.divergence * 1e-3,
                          found.depth,
                          pulse.slant_range,
                          sensor.x,
                          sensor.y,
                          pulse.sensor.height - options.geoid_separation,
                          sensor.convergence / kDegree,
                          sensor.scale};
    static_assert(std::size(row) == std::size(kTruthColumns));
    bytes.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  return bytes;
}

// The wander angle alpha turns the horizontal axes: platform heading = true heading + alpha, and
//     v_N = v_x cos(alpha) - v_y sin(alpha),   v_E = -(v_x sin(alpha) + v_y cos(alpha)),   v_U = v_z,
// here solved for v_x and v_y. It changes with longitude as the meridians converge. Accelerations and body rates are
// not simulated and 0.
std::string SbetFile(const SimulatedSurvey& survey, const TrajectoryOptions& options) {
  std::string bytes;
  VisitRecords(survey, options, options.rate, [&](double time, const AircraftState& state) {
    const Geodetic& position = state.position;
    const double alpha =
        options.wander - (position.longitude - survey.options.longitude) * std::sin(survey.options.latitude);
    const double north = state.velocity.x(), east = state.velocity.y();
    Append(bytes,
           {time, position.latitude, std::remainder(position.longitude, 2 * std::numbers::pi), position.height,
            north * std::cos(alpha) - east * std::sin(alpha), -north * std::sin(alpha) - east * std::cos(alpha),
            state.velocity.z(), state.roll, state.pitch, Wrapped(state.heading + alpha), alpha, 0, 0, 0, 0, 0, 0});
  });
  return bytes;
}

std::string SmrmsgFile(const SimulatedSurvey& survey, const TrajectoryOptions& options) {
  std::string bytes;
  VisitRecords(survey, options, options.error_rate, [&](double time, const AircraftState&) {
    Append(bytes, {time, kPositionSigma, kPositionSigma, kHeightSigma, kVelocitySigma, kVelocitySigma, kVelocitySigma,
                   kRollSigma / kArcMinute, kRollSigma / kArcMinute, kHeadingSigma / kArcMinute});
  });
  return bytes;
}

std::string AsciiTrajectory(const SimulatedSurvey& survey, const TrajectoryOptions& options) {
  const MapGrid grid = *FindMapGrid(survey.options.grid);
  std::string text;
  VisitRecords(survey, options, options.rate, [&](double time, const AircraftState& state) {
    const Geodetic& position = state.position;
    const GridPoint point = grid.projection != nullptr ? grid.At(position.latitude, position.longitude) : GridPoint{};
    char line[400];
    std::snprintf(line, sizeof line, "%.6f %.12f %.12f %.5f %.5f %.5f %.7f %.7f %.7f %.3f %.3f %.3f %.5f %.5f %.5f\n",
                  time, std::remainder(position.longitude / kDegree, 360), position.latitude / kDegree,
                  point.x * grid.metres_per_unit, point.y * grid.metres_per_unit, position.height, state.roll / kDegree,
                  state.pitch / kDegree, Wrapped(state.heading) / kDegree, kPositionSigma, kPositionSigma, kHeightSigma,
                  kRollSigma / kDegree, kRollSigma / kDegree, kHeadingSigma / kDegree);
    text += line;
  });
  return text;
}

}  // namespace albtpu::testing
