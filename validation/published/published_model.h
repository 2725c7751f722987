// The paper's summary of its simulations, Birkebak et al. (2018), Eq. 27-30: 2 sigma of the refraction angle
// over wind, incidence and diameter of the beam. In the units of its print, degrees and m/s.
#pragma once

#include <vector>

namespace albtpu {

// (wind_incidence theta + wind) w + incidence theta + constant, in degrees, of the incidence theta [degree]
// and the wind w [m/s].
struct AngleModel {
  double wind_incidence, wind, incidence, constant;

  double operator()(double wind_speed, double incidence_degrees) const {
    return (wind_incidence * incidence_degrees + wind) * wind_speed + incidence * incidence_degrees +
           constant;
  }
};

// At a diameter of 0.25 m. Printed are 0.00276 theta and 0.00281 theta, a decimal too small: as read here the
// mean residual to Table 3 falls from -0.24 to 0.01 degrees along the wind, from 0.27 to 0.02 degrees across
// it.
inline constexpr AngleModel kPublishedAlongWind = {0.003, 0.4193, 0.0276, 1.6208};  // Eq. 27
inline constexpr AngleModel kPublishedCrossWind = {-0.0009, 0.0063, -0.0281, 2.3};  // Eq. 28

// How the angles fall with the diameter [m]: Eq. 29 and 30 over their value at 0.25 m, for as printed they
// are not 1 at the diameter of Eq. 27 and 28.
inline constexpr double kPublishedAlongWindExponent = -0.641;  // Eq. 29
inline constexpr double kPublishedCrossWindExponent = -0.951;  // Eq. 30
double PublishedAlongWindDiameterFactor(double diameter);
double PublishedCrossWindDiameterFactor(double diameter);

// An angle of ours or the paper's.
struct AngleSample {
  double wind_speed, incidence_degrees, angle_degrees;
};
// The model with the least sum of squared residuals. The samples must determine it: two winds and two
// incidences at least, each with each.
AngleModel FitAngleModel(const std::vector<AngleSample>& samples);

}  // namespace albtpu
