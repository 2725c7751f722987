// Even harmonics of the cosine-2S spreading, D(psi) in proportion to |cos(psi / 2)|^(2 s), for any s from 0 (isotropic)
// to infinity (long-crested).
#pragma once

#include <array>

#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// The means of cos(2 n psi) over D: products of (s - j + 1) / (s + j) over j from 1 to 2 n.
//
// Source: Longuet-Higgins, Cartwright and Smith (1963), in Ocean Wave Spectra, 111-136.
std::array<double, kSeaHarmonics> Cosine2sHarmonics(double s);

// s of a spreading whose circular standard deviation sqrt(2 (1 - r1)) is `spread` [rad], from 0 to sqrt(2); r1 is
// s / (s + 1). Kuik, van Vledder and Holthuijsen (1988), J. Phys. Oceanogr. 18, 1020-1034, define it so.
double Cosine2sOfSpread(double spread);

// s at `f` times the frequency of the peak: 10 f^5 up to it, 10 f^-2.5 above. Mitsuyasu et al. (1975),
// doi:10.1175/1520-0485(1975)005<0750:OOTDSO>2.0.CO;2, whose s at the peak grows with the wave's age; here it is 10.
double MitsuyasuS(double f);

}  // namespace albtpu
