// How fast waves travel: capillary-gravity waves on deep, clean, fresh water.
//
//     omega^2 = g k + (T / rho) k^3
//
// A finite depth h multiplies both terms by tanh(k h). In the tank of Birkebak et al. (2018), 2.4 m deep,
// that is below 1 by 1e-9 for waves of 1.4 m and by less for shorter ones.
#pragma once

namespace albtpu {

inline constexpr double kSurfaceTension = 0.07274;  // N/m, pure water at 20 C: IAPWS R1-76 (2014)
inline constexpr double kWaterDensity = 998.2;      // kg/m^3, the same: IAPWS R6-95 (2018)

double AngularFrequency(double wavenumber);   // rad/s, of k in rad/m, not negative
double Wavenumber(double angular_frequency);  // rad/m, of omega in rad/s, not negative: the inverse
double GroupSpeed(double wavenumber);         // d omega / d k, m/s; k above 0

}  // namespace albtpu
