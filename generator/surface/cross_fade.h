// How the power of the waves is shared between two ways of drawing them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace albtpu {

// The share of the patch: 0 for waves longer than `all_long`, 1 for waves shorter than `all_patch`, a smooth
// passage in the logarithm of the wavenumber between them. A sharp cut would fall through the cells of the
// patch's lattice.
class CrossFade {
 public:
  CrossFade(double all_long, double all_patch)
      : all_long_(all_long), all_patch_(all_patch) {}  // rad/m, increasing

  double operator()(double k) const {
    const double t = std::clamp(std::log(k / all_long_) / std::log(all_patch_ / all_long_), 0.0, 1.0);
    return 0.5 - 0.5 * std::cos(std::numbers::pi * t);
  }
  double all_patch() const { return all_patch_; }

 private:
  double all_long_, all_patch_;
};

}  // namespace albtpu
