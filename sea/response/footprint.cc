#include "sea/response/footprint.h"

#include <cmath>
#include <numbers>

namespace albtpu {

std::string_view Name(BeamProfile profile) {
  return profile == BeamProfile::kUniform ? "uniform" : "gaussian";
}

std::optional<BeamProfile> FindBeamProfile(std::string_view name) {
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    if (name == Name(profile)) return profile;
  }
  return std::nullopt;
}

double RelativeIrradiance(BeamProfile profile, double squared_radius) {
  if (profile == BeamProfile::kGaussian) return std::exp(-8 * squared_radius);
  return squared_radius < 0.25 ? 1 : 0;
}

double RadiusOfPower(BeamProfile profile, double power) {
  switch (profile) {
    case BeamProfile::kUniform:
      return 0.5 * std::sqrt(power);
    case BeamProfile::kGaussian:
      return std::sqrt(-std::log1p(-power) / 8);
  }
  return 0;
}

double FootprintOverlap(BeamProfile profile, double apart) {
  if (profile == BeamProfile::kGaussian) return std::exp(-4 * apart * apart);
  return apart < 1 ? 2 / std::numbers::pi * (std::acos(apart) - apart * std::sqrt(1 - apart * apart)) : 0;
}

double WidthOnWater(const BeamOptions& beam) {
  const double width = beam.profile == BeamProfile::kGaussian ? 2 * beam.footprint : beam.footprint;
  return width / std::cos(beam.incidence);
}

double FootprintAverage(const BeamOptions& beam, double k, double psi) {
  const double along = k * std::cos(psi - beam.azimuth) / std::cos(beam.incidence);
  const double across = k * std::sin(psi - beam.azimuth);
  const double kappa = std::hypot(along, across);
  if (beam.profile == BeamProfile::kGaussian) {
    return std::exp(-kappa * kappa * beam.footprint * beam.footprint / 32);
  }
  const double argument = kappa * beam.footprint / 2;
  if (argument < 1e-4) return 1;  // the next term of the series is -argument^2 / 8
  return 2 * ::j1(argument) / argument;
}

double FootprintPower(const BeamOptions& beam, double k, double psi) {
  const double average = FootprintAverage(beam, k, psi);
  return average * average;
}

}  // namespace albtpu
