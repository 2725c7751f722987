#include "tests/flights/trajectory_files.h"

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
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

}  // namespace

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
           {time, position.latitude, position.longitude, position.height,
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
    const MapPoint point =
        grid.projection.has_value() ? grid.projection->Project(position.latitude, position.longitude) : MapPoint{};
    char line[400];
    std::snprintf(line, sizeof line, "%.6f %.12f %.12f %.5f %.5f %.5f %.7f %.7f %.7f %.3f %.3f %.3f %.5f %.5f %.5f\n",
                  time, position.longitude / kDegree, position.latitude / kDegree, point.easting, point.northing,
                  position.height, state.roll / kDegree, state.pitch / kDegree, Wrapped(state.heading) / kDegree,
                  kPositionSigma, kPositionSigma, kHeightSigma, kRollSigma / kDegree, kRollSigma / kDegree,
                  kHeadingSigma / kDegree);
    text += line;
  });
  return text;
}

}  // namespace albtpu::testing
