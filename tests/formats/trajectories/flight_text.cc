#include "tests/formats/trajectories/flight_text.h"

#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "sea/angle.h"

namespace albtpu::testing {

FlightLine LineOf(const FlightSpec& spec, std::size_t line) {
  constexpr double kRadius = 6378137;  // m; a sphere is near enough for a short flight.
  const double course = RadiansOfDegrees(spec.course);
  const double since_start = static_cast<double>(line) / spec.rate;
  const double north = spec.speed * std::cos(course) * since_start;
  const double east = spec.speed * std::sin(course) * since_start;
  const double cosine = std::cos(RadiansOfDegrees(spec.latitude));
  return {.time = spec.start + since_start,
          .longitude = spec.longitude + DegreesOfRadians(east / (kRadius * cosine)),
          .latitude = spec.latitude + DegreesOfRadians(north / kRadius),
          .x = 540000 + east,
          .y = 2776000 + north,
          .height = 400 + std::sin(since_start),
          .roll = 1.5,
          .pitch = -0.5,
          .heading = spec.course + 3,
          .velocity_east = spec.speed * std::sin(course),
          .velocity_north = spec.speed * std::cos(course),
          .velocity_up = std::cos(since_start),
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

std::string SbetBytes(const FlightSpec& spec) {
  constexpr double kWander = 0.3;  // rad
  std::string bytes;
  for (std::size_t i = 0; i < spec.lines; ++i) {
    FlightLine l = LineOf(spec, i);
    spec.change(l);
    const double x = l.velocity_north * std::cos(kWander) - l.velocity_east * std::sin(kWander);
    const double y = -l.velocity_north * std::sin(kWander) - l.velocity_east * std::cos(kWander);
    bytes += Bytes({l.time, RadiansOfDegrees(l.latitude), RadiansOfDegrees(l.longitude), l.height, x, y, l.velocity_up,
                    RadiansOfDegrees(l.roll), RadiansOfDegrees(l.pitch), RadiansOfDegrees(l.heading) + kWander, kWander,
                    0, 0, -9.8, 0, 0, 0});
  }
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
