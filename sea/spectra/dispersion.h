// The dispersion relation of gravity waves in water of constant depth without current: omega^2 = g k tanh(k h).
//
// Source: any text of water waves, for example Dean and Dalrymple (1991), Water Wave Mechanics, Eq. 3.34. Depths are in
// m, above 0; infinity means deep water.
#pragma once

namespace albtpu {

// k [rad/m] of waves of frequency `f` [Hz, above 0], to 1e-14 of itself.
double WavenumberOfFrequency(double f, double depth);

// f [Hz] of waves of wavenumber `k` [rad/m, above 0].
double FrequencyOfWavenumber(double k, double depth);

// df/dk [Hz m/rad], the group velocity over 2 pi, of waves of wavenumber `k`: E(f) df/dk is S(k).
double FrequencySlope(double k, double depth);

// 2 k h / sinh(2 k h): 0 in deep water, 1 in shallow.
double Shallowness(double k, double depth);

}  // namespace albtpu
