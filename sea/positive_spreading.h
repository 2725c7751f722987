// A spreading of waves with given even harmonics that is nowhere negative.
#pragma once

#include <vector>

namespace albtpu {

// D(psi) [1/rad], equal for psi and psi + pi; its integral over a full turn is 1. Immutable.
//
// The means of cos(2 n psi) and sin(2 n psi), n from 1, are `a[n - 1]` and `b[n - 1]`. Their Fourier series
//     (1 + 2 sum of (a_n cos(2 n psi) + b_n sin(2 n psi))) / (2 pi)
// is taken if it is nowhere negative. Instruments and truncated series may give harmonics of which it is: then it is
// the density of maximum entropy with these harmonics, the exponential of a series of as many terms (Lygre and Krogstad
// (1986), doi:10.1175/1520-0485(1986)016<2052:MEEOTD>2.0.CO;2), and harmonics at the end that are 0 count as not known.
// Harmonics that only a beam of waves narrower than some 4 degrees or no density has are met in part.
class PositiveSpreading {
 public:
  PositiveSpreading(const std::vector<double>& a, const std::vector<double>& b);  // as many, at least one

  double operator()(double psi) const;

 private:
  bool exponential_ = false;
  double constant_ = 1;
  std::vector<double> cosine_, sine_;  // of the series, or of that in the exponent
};

}  // namespace albtpu
