#include "validation/studies/observed_seas.h"

#include <algorithm>
#include <cmath>

#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

constexpr double kAnemometerOfCoxAndMunk = 12.5;        // m
constexpr double kAnemometerOfPiersonMoskowitz = 19.5;  // m

}  // namespace

ObservedSlope CoxMunkAlongWind(double wind_speed_10m) {
  return {0.000 + 3.16e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.004};
}

ObservedSlope CoxMunkCrossWind(double wind_speed_10m) {
  return {0.003 + 1.92e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.002};
}

ObservedSlope CoxMunkTotal(double wind_speed_10m) {
  return {0.003 + 5.12e-3 * WindSpeedAt(kAnemometerOfCoxAndMunk, wind_speed_10m), 0.004};
}

double PiersonMoskowitzWaveHeight(double wind_speed_19_5m) {
  constexpr double kAlpha = 8.1e-3, kBeta = 0.74;
  return 2 * std::sqrt(kAlpha / kBeta) * wind_speed_19_5m * wind_speed_19_5m / kGravity;
}

double PiersonMoskowitzWaveHeightOf(double wind_speed_10m) {
  return PiersonMoskowitzWaveHeight(WindSpeedAt(kAnemometerOfPiersonMoskowitz, wind_speed_10m));
}

double JonswapWaveHeight(double wind_speed_10m, double fetch) {
  const double scale = wind_speed_10m * wind_speed_10m / kGravity;  // m
  return std::min(4 * std::sqrt(1.6e-7 * fetch / scale) * scale,
                  PiersonMoskowitzWaveHeightOf(wind_speed_10m));
}

}  // namespace albtpu
