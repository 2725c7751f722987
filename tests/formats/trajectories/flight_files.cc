#include "tests/formats/trajectories/flight_files.h"

#include <cmath>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace albtpu::testing {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

SbetRow RowAt(const Flight& flight, double time) {
  const double course = flight.course * kDegree;
  const double latitude_0 = flight.latitude * kDegree;
  // Radians in a metre at the start. The rates of the angles are constant; the velocities follow from them exactly.
  const double per_north = 1 / MeridianRadius(latitude_0);
  const double per_east = 1 / (PrimeVerticalRadius(latitude_0) * std::cos(latitude_0));
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

  const double north = (MeridianRadius(latitude) + height) * latitude_rate;
  const double east = (PrimeVerticalRadius(latitude) + height) * std::cos(latitude) * longitude_rate;
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

FlightLine LineOf(const FlightSpec& spec, std::size_t line) {
  const double since_start = static_cast<double>(line) / spec.rate, course = spec.course * kDegree;
  const SbetRow row = RowAt({.start = spec.start,
                             .latitude = spec.latitude,
                             .longitude = spec.longitude,
                             .speed = spec.speed,
                             .course = spec.course,
                             .weave = 0,
                             .climb = 1,
                             .wander = 0},
                            since_start);
  return {.time = row[kTime],
          .longitude = row[kLongitude] / kDegree,
          .latitude = row[kLatitude] / kDegree,
          .x = 540000 + spec.speed * std::sin(course) * since_start,
          .y = 2776000 + spec.speed * std::cos(course) * since_start,
          .height = row[kHeight],
          .roll = 1.5,
          .pitch = -0.5,
          .heading = spec.course + 3,
          .velocity_east = -row[kVelocityY],
          .velocity_north = row[kVelocityX],
          .velocity_up = row[kVelocityZ],
          .sigma_x = 0.02,
          .sigma_y = 0.03,
          .sigma_z = 0.05,
          .sigma_roll = 0.0025,
          .sigma_pitch = 0.0026,
          .sigma_heading = 0.005};
}

std::string FlightText(const FlightSpec& spec) {
  std::string text = spec.header;
  for (std::size_t i = 0; i < spec.lines; ++i) {
    FlightLine l = LineOf(spec, i);
    spec.change(l);
    std::vector<double> values = {l.time, l.longitude, l.latitude, l.x, l.y, l.height, l.roll, l.pitch, l.heading};
    if (spec.columns == 20) {
      values = {l.time,   0,      l.x,     l.y,       l.height - 1,    l.latitude,       l.longitude,
                l.height, l.roll, l.pitch, l.heading, l.velocity_east, l.velocity_north, l.velocity_up};
    }
    for (const double sigma : {l.sigma_x, l.sigma_y, l.sigma_z, l.sigma_roll, l.sigma_pitch, l.sigma_heading})
      values.push_back(sigma);
    std::vector<std::string> cells;
    for (const double value : values) cells.push_back(absl::StrFormat("%.*f", spec.decimals, value));
    absl::StrAppend(&text, absl::StrJoin(cells, spec.separator), "\n");
  }
  return text;
}

std::string Bytes(std::initializer_list<double> numbers) {
  std::string bytes;
  for (const double number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return bytes;
}

std::string SmrmsgBytes(double start, std::size_t records) {
  std::string bytes;
  for (std::size_t i = 0; i < records; ++i) {
    bytes += Bytes({start + static_cast<double>(i)});
    for (int field = 1; field < 10; ++field) bytes += Bytes({0.01 * (field + 1) * (1 + static_cast<double>(i) / 10)});
  }
  return bytes;
}

}  // namespace albtpu::testing
