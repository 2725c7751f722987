#include "annotate/answers/beam_coordinates.h"

#include <cmath>
#include <numbers>

namespace albtpu::annotate {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kRadiansPerMilliradian = 1e-3;

}  // namespace

double FootprintDiameter(double altitude, double divergence, double incidence) {
  return altitude / std::cos(incidence * kRadiansPerDegree) * (divergence * kRadiansPerMilliradian);
}

double AzimuthFromDownwind(double beam_azimuth, double wind_from) { return beam_azimuth - (wind_from + 180); }

}  // namespace albtpu::annotate
