// Where scanners point, in their own axes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace albtpu::testing {

enum class ScannerKind {
  kCone,     // 20 degrees from nadir in every direction: a Palmer scanner.
  kEllipse,  // 20 degrees across track, 14 along.
  kRaster,   // 20 degrees to either side, across track only.
};

// "palmer" (or "cone"), "ellipse", "raster".
std::optional<ScannerKind> FindScanner(std::string_view name);

// Unit vector (forward, right, down) at `turns`, the number of periods of the scanner since the beginning.
Eigen::Vector3d BeamDirection(ScannerKind kind, double turns);

}  // namespace albtpu::testing
