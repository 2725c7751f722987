#include "tests/flights/scanner.h"

#include <cmath>
#include <numbers>

namespace albtpu::testing {
namespace {

const double kTangentAcross = std::tan(20 * std::numbers::pi / 180);
const double kTangentAlong = std::tan(14 * std::numbers::pi / 180);

}  // namespace

std::optional<ScannerKind> FindScanner(std::string_view name) {
  if (name == "palmer" || name == "cone") return ScannerKind::kCone;
  if (name == "ellipse") return ScannerKind::kEllipse;
  if (name == "raster") return ScannerKind::kRaster;
  return std::nullopt;
}

Eigen::Vector3d BeamDirection(ScannerKind kind, double turns) {
  const double phase = 2 * std::numbers::pi * turns;
  const double along = kind == ScannerKind::kCone ? kTangentAcross : kind == ScannerKind::kEllipse ? kTangentAlong : 0;
  return Eigen::Vector3d(along * std::cos(phase), kTangentAcross * std::sin(phase), 1).normalized();
}

}  // namespace albtpu::testing
