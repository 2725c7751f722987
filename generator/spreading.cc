#include "generator/spreading.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {

Cosine2sSpreading::Cosine2sSpreading(double s)
    : s_(s),
      normalization_(std::exp2(2 * s - 1) / std::numbers::pi *
                     std::exp(2 * std::lgamma(s + 1) - std::lgamma(2 * s + 1))) {
  assert(s > 0);
}

double Cosine2sSpreading::operator()(double psi) const {
  return normalization_ * std::pow(std::abs(std::cos(psi / 2)), 2 * s_);
}

}  // namespace albtpu
