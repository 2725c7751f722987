#include "quality/report/limit_margins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace albtpu::quality {
namespace {

// Bin i has margins from kLeastMargin exp(kMarginStep i) on; what is less is in none, what is more in the last.
constexpr double kLeastMargin = 1e-3, kMarginStep = 0.002;
constexpr std::size_t kMarginBins = 8000;  // To 8900.

double MarginBin(double factor) { return std::log(factor / kLeastMargin) / kMarginStep; }

}  // namespace

void LimitMargins::Add(double margin) {
  if (bins_.empty()) bins_.resize(kMarginBins);
  const double bin = margin > 0 ? MarginBin(margin) : -1;
  if (bin >= 0) ++bins_[bin < kMarginBins ? static_cast<std::size_t>(bin) : kMarginBins - 1];
}

std::uint64_t LimitMargins::Within(double factor) const {
  if (bins_.empty()) return 0;
  const double first = factor > kLeastMargin ? std::ceil(MarginBin(factor) - 1e-9) : 0;
  std::uint64_t points = 0;
  for (auto bin = static_cast<std::size_t>(std::min<double>(first, kMarginBins)); bin < kMarginBins; ++bin)
    points += bins_[bin];
  return points;
}

}  // namespace albtpu::quality
