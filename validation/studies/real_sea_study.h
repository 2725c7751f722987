// Measurements of real seas: slopes from sun glitter, wave heights over wind and over fetch.
#pragma once

namespace albtpu {

// A mean square slope and the standard deviation of the observations about it.
struct ObservedSlope {
  double mean_square, scatter;
};

// Cox and Munk (1954), J. Opt. Soc. Am. 44, 838-850, doi:10.1364/JOSA.44.000838, clean surface: along the wind 0.000
// + 3.16e-3 U +- 0.004, across 0.003 + 1.92e-3 U +- 0.002, together 0.003 + 5.12e-3 U +- 0.004. Their anemometer
// stood 12.5 m (41 feet) above the water; WindSpeedAt() of wind_sea.h converts the wind at 10 m [m/s] to that height.
// The observations are from 1 to 14 m/s.
ObservedSlope CoxMunkAlongWind(double wind_speed_10m);
ObservedSlope CoxMunkCrossWind(double wind_speed_10m);
ObservedSlope CoxMunkTotal(double wind_speed_10m);

// Significant wave height [m] of the fully developed sea of Pierson and Moskowitz (1964),
// doi:10.1029/JZ069i024p05181: four times the root of the integral of their spectrum, 2 sqrt(alpha / beta)
// U^2 / g with alpha = 8.1e-3, beta = 0.74 and U the wind at 19.5 m: 0.21 U^2 / g.
double PiersonMoskowitzWaveHeight(double wind_speed_19_5m);

// The same for the wind at 10 m, converted by WindSpeedAt(). Some authors use the wind at 10 m unconverted, which
// gives 9 to 15 % less.
double PiersonMoskowitzWaveHeightOf(double wind_speed_10m);

// Significant wave height [m] after a fetch [m] by JONSWAP, Hasselmann et al. (1973): variance of elevation 1.6e-7
// (U^2 / g)^2 (g x / U^2), U the wind at 10 m. The law has no upper limit: here the height of the fully developed sea
// limits it.
double JonswapWaveHeight(double wind_speed_10m, double fetch);

}  // namespace albtpu
