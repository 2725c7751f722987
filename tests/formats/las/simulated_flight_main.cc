// albtpu_simulated_flight OUT.las [VERSION_MINOR POINT_FORMAT [EXTRA_BYTES]]
//
// Writes a small flight line over a sloping bottom, always the same, for use where no survey is available; by default
// as LAS 1.4 with point format 6. The aircraft flies north, 400 m above the water (z = 0), and scans across track, 20
// degrees to either side. From a beach the bottom slopes to a depth of 18 m. About 24 000 points in UTM metres, of
// classes 2 ground, 40 bathymetric bottom and 41 water surface; each pulse has its GPS time. Formats 0-5, whose classes
// end at 31, have 26 instead of 40 and 9 instead of 41.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numbers>

#include "tests/formats/las/las_builder.h"

namespace {

using albtpu::testing::LasSpec;

constexpr int kLines = 220;
constexpr int kBeachLines = 20;
constexpr int kPulsesPerLine = 101;
constexpr double kLineSpacing = 1.5;   // m
constexpr double kSpeed = 60;          // m/s
constexpr double kStart = 330760000;   // s, GPS time less 1e9: in week 2200
constexpr double kAltitude = 400;      // m
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

LasSpec SimulateFlight(int version_minor, int point_format) {
  constexpr double kEast = 400000, kNorth = 2800000, kScale = 0.01;  // m
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  spec.scale = kScale;
  spec.adjusted_time = true;
  spec.vlrs.push_back({"LASF_Projection", 2112, std::string(albtpu::testing::kMetricWkt) + '\0'});
  const int bottom_class = point_format < 6 ? 26 : 40, surface_class = point_format < 6 ? 9 : 41;
  double time = kStart;  // Of the pulse.
  const auto add = [&](double x, double y, double z, int classification, double scan_angle) {
    spec.points.push_back({static_cast<std::int32_t>(std::lround((kEast + x) / kScale)),
                           static_cast<std::int32_t>(std::lround((kNorth + y) / kScale)),
                           static_cast<std::int32_t>(std::lround(z / kScale)), classification, scan_angle, time});
  };
  for (int line = 0; line < kLines; ++line) {
    for (int pulse = 0; pulse < kPulsesPerLine; ++pulse) {
      const double scan_angle = kScanHalfAngle * (2.0 * pulse / (kPulsesPerLine - 1) - 1);  // Left to right.
      const double x = kAltitude * std::tan(scan_angle * kDegree);
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "albtpu_simulated_flight: no output; give a file to write\n";
    return 2;
  }
  const int version_minor = argc > 2 ? std::atoi(argv[2]) : 4;
  const int point_format = argc > 3 ? std::atoi(argv[3]) : 6;
  LasSpec spec = SimulateFlight(version_minor, point_format);
  if (argc > 4) spec.extra_bytes = static_cast<std::size_t>(std::atoi(argv[4]));
  std::ofstream file(argv[1], std::ios::binary);
  file << albtpu::testing::BuildLas(spec) << std::flush;
  if (!file) std::cerr << "albtpu_simulated_flight: " << argv[1] << " cannot be written; give another file\n";
  return file ? 0 : 1;
}
