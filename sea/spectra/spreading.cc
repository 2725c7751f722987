#include "sea/spectra/spreading.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// std::lgamma() writes the sign to a variable that all threads share.
double LogGamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

}  // namespace

Cosine2sSpreading::Cosine2sSpreading(double s)
    : s_(s),
      normalization_(std::exp2(2 * s - 1) / std::numbers::pi *
                     std::exp(2 * LogGamma(s + 1) - LogGamma(2 * s + 1))) {
  assert(s > 0);
}

double Cosine2sSpreading::operator()(double psi) const {
  return normalization_ * std::pow(std::abs(std::cos(psi / 2)), 2 * s_);
}

}  // namespace albtpu
