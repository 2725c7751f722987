// The peak of a growing sea over that of a fully developed one, which both spectra have.
#pragma once

#include <algorithm>
#include <cmath>

namespace albtpu {

// gamma^Gamma of a sea of inverse wave age Omega: JONSWAP's enhancement with the widths of Donelan et al. (1985).
//
// Source: Birkebak et al. (2018), Eq. 6-9; Elfouhaily et al. (1997), Eq. 3. The logarithm is of base 10. It is given
// for Omega of 1 to 5, short fetches go beyond: gamma is held at its ends.
class JonswapPeak {
 public:
  explicit JonswapPeak(double omega)
      : gamma_(1.7 + 6 * std::log10(std::clamp(omega, 1.0, 5.0))),
        sigma_(0.08 * (1 + 4 / (omega * omega * omega))) {}

  // `ratio` is the wavenumber over that of the peak.
  double operator()(double ratio) const {
    const double from_peak = std::sqrt(ratio) - 1;
    return std::pow(gamma_, std::exp(-(from_peak * from_peak) / (2 * (sigma_ * sigma_))));
  }

 private:
  double gamma_, sigma_;
};

}  // namespace albtpu
