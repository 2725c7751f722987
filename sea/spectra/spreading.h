// Directional spreading D(psi) [1/rad] of waves about the wind, with integral of D over a full turn = 1.
#pragma once

namespace albtpu {

// D(psi) = C(s) cos^{2s}(psi / 2), psi in rad from downwind.
//
// Source: Birkebak et al. (2018), Eq. 15, after Mitsuyasu et al. (1975); s = 2 for short waves. The slope
// variances along and across the wind of a sea with s = 2 stand as 7 to 5.
class Cosine2sSpreading {
 public:
  explicit Cosine2sSpreading(double s = 2);  // s above 0

  double operator()(double psi) const;

 private:
  double s_, normalization_;
};

}  // namespace albtpu
