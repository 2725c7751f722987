// The response of the refracted ray to the slope of the water in a sea of finite slopes: the mean gain and the mean
// curvature of Snell's law over all slopes of the sea.
#pragma once

#include <Eigen/Core>
#include <array>

namespace albtpu {

// F(m) = (tangent along the azimuth, tangent across it, secant) of the ray that a facet of slope m refracts, m along
// and across the azimuth too. E is the mean over the slopes of the sea; E_w weights each slope by the area that it
// turns towards the beam, 1 + tau . m with tau = (tan(incidence), 0).
struct EffectiveGains {
  // E_w[F].
  Eigen::Vector3d mean;
  // E_w[dF/dm] + (E[F] - E_w[F]) tau^T. By Stein's lemma this is the covariance of F and m under the weight, times the
  // inverse of the slopes' covariance: the linear part of the response to Gaussian waves (Bussgang's theorem).
  Eigen::Matrix<double, 3, 2> gain;
  // E_w[d^2 F_i / dm dm] of each component: the part of second order.
  std::array<Eigen::Matrix2d, 3> curvature;
};

// `slopes` is the covariance of the slopes of the whole sea along and across the azimuth. The quadrature of 10 x 10
// points is accurate to 1e-7, and so are the differences by which it is derived.
EffectiveGains EffectiveGainsOf(double incidence, double refractive_index, const Eigen::Matrix2d& slopes);

}  // namespace albtpu
