// The scattering of light by water: phase functions, their moments, and random angles from them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace albtpu {

// A phase function that depends on the angle psi [radian, 0 to pi] between the directions before and after alone. The
// fraction that is scattered by less than psi is known in closed form for both; everything else follows from it.
//
//     const PhaseFunction ocean = PhaseFunction::FournierForand(0.0183);  // Petzold's mean ocean particle
//     const double sine = ocean.SinHalf(uniform);                        // sin(psi / 2) of a scattered photon
class PhaseFunction {
 public:
  // Fournier and Jonasz (1999), doi:10.1117/12.366488, with the index of the particles and the slope of their sizes on
  // the line that Mobley et al. (2002), doi:10.1364/AO.41.001035, draw through the (backscatter fraction, shape) of
  // natural water: n = 1.01 + 0.1542 (mu - 3). `backscatter_fraction` is the fraction beyond 90 degrees, 0.001 to 0.2.
  static PhaseFunction FournierForand(double backscatter_fraction);
  // Henyey and Greenstein (1941). `g` is the mean cosine, in (0, 1). Without the forward peak of water: for tests.
  static PhaseFunction HenyeyGreenstein(double g);
  // Any other: `share_below` psi, not decreasing, 1 at pi.
  explicit PhaseFunction(const std::function<double(double)>& share_below);

  double BackscatterFraction() const { return 1 - ShareBelow(kRightAngle); }
  // The fraction that is scattered by less than `psi`; linear in sin^2(psi / 2) between close nodes.
  double ShareBelow(double psi) const;
  // The expectation of the Legendre polynomials P1 (the mean cosine) and P2, and of psi^2 [radian^2].
  double MeanCosine() const;
  double MeanSecondLegendre() const;
  double MeanSquareAngle() const;

  // sin(psi / 2) of the angle psi below which the fraction `share` in [0, 1) of the light is scattered.
  double SinHalf(double share) const;

 private:
  static constexpr double kRightAngle = 1.5707963267948966;

  template <typename Value>
  double Mean(const Value& value) const;

  // At nodes of the angle: psi, sin^2(psi / 2), and the fraction below. The first node is 0.
  std::vector<double> psi_, sin2_half_, share_;
  std::vector<std::uint32_t> guide_;  // The last node whose fraction is not above i / (size - 1).
};

}  // namespace albtpu
