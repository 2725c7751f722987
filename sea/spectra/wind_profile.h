// The wind over the sea: its friction velocity, and its speed at heights other than 10 m.
#pragma once

namespace albtpu {

// u* [m/s] by the drag law of Wu (1982), doi:10.1029/JC087iC12p09704: u*^2 = C U10^2, C = (0.8 + 0.065 U10)
// 1e-3 with the wind at 10 m in m/s.
double FrictionVelocity(double wind_speed_10m);

// The wind speed [m/s] at `height` [m] of the neutral logarithmic profile, von Karman's constant 0.4.
double WindSpeedAt(double height, double wind_speed_10m);

}  // namespace albtpu
