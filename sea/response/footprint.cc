#include "sea/response/footprint.h"

#include <cmath>

namespace albtpu {

double RadiusOfPower(BeamProfile profile, double power) {
  switch (profile) {
    case BeamProfile::kUniform:
      return 0.5 * std::sqrt(power);
    case BeamProfile::kGaussian:  // irradiance exp(-8 r^2 / D^2)
      return std::sqrt(-std::log1p(-power) / 8);
  }
  return 0;
}

double FootprintAverage(const BeamOptions& beam, double k, double psi) {
  const double along = k * std::cos(psi - beam.azimuth) / std::cos(beam.incidence);
  const double across = k * std::sin(psi - beam.azimuth);
  const double kappa = std::hypot(along, across);
  if (beam.profile == BeamProfile::kGaussian) {
    return std::exp(-kappa * kappa * beam.footprint * beam.footprint / 32);
  }
  const double argument = kappa * beam.footprint / 2;
  if (argument < 1e-4) return 1;  // 1 - argument^2 / 8
  return 2 * ::j1(argument) / argument;
}

double FootprintPower(const BeamOptions& beam, double k, double psi) {
  const double average = FootprintAverage(beam, k, psi);
  return average * average;
}

}  // namespace albtpu
