#include "tests/survey/las/simulated_flight.h"

#include <cmath>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr int kLines = 220;
constexpr int kBeachLines = 20;
constexpr int kPulsesPerLine = 101;
constexpr double kLineSpacing = 1.5;   // m
constexpr double kSpeed = 60;          // m/s
constexpr double kStart = 330760000;   // s, GPS time less 1e9: in week 2200
constexpr double kScanHalfAngle = 20;  // degree
constexpr double kDegree = std::numbers::pi / 180;
constexpr int kEverySurfaceReturn = 10;  // One pulse in ten also has a return from the surface.

// Depth [m] below z = 0, at `x` [m] across and `y` [m] along the line: a slope with sand ripples. Negative on the
// beach.
double Depth(double x, double y) {
  const double along = y / (kLineSpacing * kLines);
  const double beach = static_cast<double>(kBeachLines) / kLines;
  if (along < beach) return -3 * (beach - along) / beach;
  const double slope = 0.5 + 17.2 * (along - beach) / (1 - beach);
  return slope + 0.3 * std::sin(0.05 * y) * std::sin(0.03 * x);
}

}  // namespace

LasSpec SimulateFlight(int version_minor, int point_format) {
  constexpr double kEast = 400000, kNorth = 2800000, kScale = 0.01;  // m
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  spec.scale = kScale;
  spec.adjusted_time = true;
  spec.vlrs.push_back({"LASF_Projection", 2112, std::string(kMetricWkt) + '\0'});
  const int bottom_class =
      point_format < 6 ? SimulatedFlight::kLegacyBottomClass : SimulatedFlight::kBottomClass;
  const int surface_class = point_format < 6 ? 9 : 41;
  double time = kStart;  // Of the pulse.
  const auto add = [&](double x, double y, double z, int classification, double scan_angle) {
    spec.points.push_back({static_cast<std::int32_t>(std::lround((kEast + x) / kScale)),
                           static_cast<std::int32_t>(std::lround((kNorth + y) / kScale)),
                           static_cast<std::int32_t>(std::lround(z / kScale)), classification, scan_angle,
                           time});
  };
  for (int line = 0; line < kLines; ++line) {
    for (int pulse = 0; pulse < kPulsesPerLine; ++pulse) {
      const double scan_angle = kScanHalfAngle * (2.0 * pulse / (kPulsesPerLine - 1) - 1);  // Left to right.
      const double x = SimulatedFlight::kAltitude * std::tan(scan_angle * kDegree);
      const double y = line * kLineSpacing;
      time = kStart + (line + static_cast<double>(pulse) / kPulsesPerLine) * kLineSpacing / kSpeed;
      const double depth = Depth(x, y);
      if (depth < 0) {
        add(x, y, -depth, 2, scan_angle);
        continue;
      }
      if ((line + pulse) % kEverySurfaceReturn == 0) add(x, y, 0, surface_class, scan_angle);
      add(x, y, -depth, bottom_class, scan_angle);
    }
  }
  return spec;
}

}  // namespace albtpu::testing
