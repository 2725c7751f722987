#include "tests/formats/trajectories/sbet_flight.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kA = 6378137, kF = 1 / 298.257223563, kE2 = kF * (2 - kF);

}  // namespace

SbetRow RowAt(const Flight& flight, double time) {
  const double course = flight.course * kDegree;
  const double latitude_0 = flight.latitude * kDegree;
  // Radians in a metre at the start. The rates of the angles are constant; the velocities follow from them exactly.
  const double w_0 = 1 - kE2 * std::sin(latitude_0) * std::sin(latitude_0);
  const double per_north = w_0 * std::sqrt(w_0) / (kA * (1 - kE2));
  const double per_east = std::sqrt(w_0) / (kA * std::cos(latitude_0));
  const double omega = 2 * kPi / flight.weave_time;
  const double aside = flight.weave * std::sin(omega * time);
  const double aside_rate = flight.weave * omega * std::cos(omega * time);
  const double climb_omega = 2 * kPi / 20;

  const double latitude = latitude_0 + per_north * (flight.speed * time * std::cos(course) - aside * std::sin(course));
  const double longitude =
      flight.longitude * kDegree + per_east * (flight.speed * time * std::sin(course) + aside * std::cos(course));
  const double height = flight.height + flight.climb * std::sin(climb_omega * time);
  const double latitude_rate = per_north * (flight.speed * std::cos(course) - aside_rate * std::sin(course));
  const double longitude_rate = per_east * (flight.speed * std::sin(course) + aside_rate * std::cos(course));

  const double w = 1 - kE2 * std::sin(latitude) * std::sin(latitude);
  const double north = (kA * (1 - kE2) / (w * std::sqrt(w)) + height) * latitude_rate;
  const double east = (kA / std::sqrt(w) + height) * std::cos(latitude) * longitude_rate;
  const double wander = flight.wander * kDegree;
  // North and west of the wander frame: the inverse of v_N = v_x cos - v_y sin, v_E = -(v_x sin + v_y cos).
  SbetRow row = {};
  row[kTime] = flight.start + time;
  row[kLatitude] = latitude;
  row[kLongitude] = longitude;
  row[kHeight] = height;
  row[kVelocityX] = north * std::cos(wander) - east * std::sin(wander);
  row[kVelocityY] = -north * std::sin(wander) - east * std::cos(wander);
  row[kVelocityZ] = flight.climb * climb_omega * std::cos(climb_omega * time);
  row[kRoll] = flight.roll * kDegree * std::sin(2 * kPi * time / 7);
  row[kPitch] = flight.pitch * kDegree * std::sin(2 * kPi * time / 9);
  const double heading = std::atan2(east, north) + flight.crab * kDegree;
  row[kPlatformHeading] = std::remainder(heading + wander, 2 * kPi);
  row[kWander] = wander;
  for (std::size_t i = kWander + 1; i < kSbetFields; ++i) row[i] = 0.01 * static_cast<double>(i);
  return row;
}

std::vector<SbetRow> Fly(const Flight& flight) {
  const int last = static_cast<int>(std::lround(flight.duration * flight.rate));
  std::vector<SbetRow> rows;
  for (int i = 0; i <= last; ++i) rows.push_back(RowAt(flight, i / flight.rate));
  return rows;
}

std::string SbetBytes(const std::vector<SbetRow>& rows) {
  std::string bytes(rows.size() * sizeof(SbetRow), '\0');
  std::memcpy(bytes.data(), rows.data(), bytes.size());
  return bytes;
}

std::vector<SbetRow> Changed(std::vector<SbetRow> rows, const std::function<void(SbetRow&)>& change) {
  for (SbetRow& row : rows) change(row);
  return rows;
}

}  // namespace albtpu::testing
