#include "generator/water/phase_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// Between 1e-6 rad, below which a natural phase function has a thousandth of its light, and 180 degrees.
constexpr double kSmallestAngle = 1e-9;
constexpr int kNodes = 8000;
constexpr std::size_t kGuides = 1 << 16;

double Square(double x) { return x * x; }

// The fraction below psi of a Fournier-Forand function of exponent `nu` and index `n` of the particles.
struct FournierForandShare {
  double n, nu;

  double Delta(double sin2_half) const { return 4 * sin2_half / (3 * Square(n - 1)); }

  double operator()(double psi) const {
    const double s = Square(std::sin(psi / 2));
    if (s == 0) return 0;
    const double at_pi = std::pow(Delta(1), nu);
    const double beyond = (1 - at_pi) / (8 * (Delta(1) - 1) * at_pi) * std::cos(psi) * Square(std::sin(psi));
    const double delta = Delta(s);
    if (std::abs(delta - 1) < 1e-5) return (*this)(psi * (1 + 1e-4)) / 2 + (*this)(psi * (1 - 1e-4)) / 2;
    const double power = std::pow(delta, nu);
    return ((1 - power * delta) - (1 - power) * s) / ((1 - delta) * power) + beyond;
  }
};

FournierForandShare OfSlope(double mu) { return {1.01 + 0.1542 * (mu - 3), (3 - mu) / 2}; }

}  // namespace

PhaseFunction::PhaseFunction(const std::function<double(double)>& share_below) : psi_{0} {
  const double step = std::log(kPi / kSmallestAngle) / (kNodes - 1);
  for (int i = 0; i < kNodes - 1; ++i) psi_.push_back(kSmallestAngle * std::exp(i * step));
  psi_.push_back(kPi);
  for (const double psi : psi_) {
    sin2_half_.push_back(Square(std::sin(psi / 2)));
    share_.push_back(psi == 0 ? 0 : std::clamp(share_below(psi), share_.back(), 1.0));
  }
  share_.back() = 1;
  guide_.resize(kGuides + 1);
  std::uint32_t node = 0;
  for (std::size_t i = 0; i <= kGuides; ++i) {
    const double share = static_cast<double>(i) / kGuides;
    while (node + 2 < share_.size() && share_[node + 1] <= share) ++node;
    guide_[i] = node;
  }
}

PhaseFunction PhaseFunction::FournierForand(double backscatter_fraction) {
  // The fraction grows with the slope of the sizes.
  double least = 3.01, most = 4.9;
  for (int i = 0; i < 60; ++i) {
    const double middle = (least + most) / 2;
    (1 - OfSlope(middle)(kRightAngle) < backscatter_fraction ? least : most) = middle;
  }
  return PhaseFunction(OfSlope((least + most) / 2));
}

PhaseFunction PhaseFunction::HenyeyGreenstein(double g) {
  // 1 + g^2 - 2 g cos(psi) = (1 - g)^2 + 4 g sin^2(psi / 2), without the cancellation at small angles.
  return PhaseFunction([g](double psi) {
    const double root = std::sqrt(Square(1 - g) + 4 * g * Square(std::sin(psi / 2)));
    const double below = 4 * g * Square(std::sin(psi / 2)) / (root + 1 - g);  // root - (1 - g)
    return (1 + g) / (2 * g) * below / root;
  });
}

double PhaseFunction::ShareBelow(double psi) const {
  const auto above = std::upper_bound(psi_.begin() + 1, psi_.end() - 1, psi);
  const auto i = static_cast<std::size_t>(above - psi_.begin());
  const double fraction =
      (Square(std::sin(psi / 2)) - sin2_half_[i - 1]) / (sin2_half_[i] - sin2_half_[i - 1]);
  return share_[i - 1] + std::clamp(fraction, 0.0, 1.0) * (share_[i] - share_[i - 1]);
}

// Light between two nodes is even in sin^2(psi / 2), as SinHalf draws it.
template <typename Value>
double PhaseFunction::Mean(const Value& value) const {
  double sum = 0;
  for (std::size_t i = 1; i < psi_.size(); ++i) {
    const double middle = value((sin2_half_[i - 1] + sin2_half_[i]) / 2);
    const double mean = (value(sin2_half_[i - 1]) + 4 * middle + value(sin2_half_[i])) / 6;
    sum += (share_[i] - share_[i - 1]) * mean;
  }
  return sum;
}

double PhaseFunction::MeanCosine() const {
  return 1 - Mean([](double sin2_half) { return 2 * sin2_half; });
}

double PhaseFunction::MeanSecondLegendre() const {
  // (3 cos^2 - 1) / 2 with cos = 1 - 2 s.
  return 1 - Mean([](double sin2_half) { return 6 * sin2_half * (1 - sin2_half); });
}

double PhaseFunction::MeanSquareAngle() const {
  return Mean([](double sin2_half) { return Square(2 * std::asin(std::sqrt(sin2_half))); });
}

double PhaseFunction::SinHalf(double share) const {
  std::size_t i = guide_[static_cast<std::size_t>(share * kGuides)];
  while (share_[i + 1] <= share && i + 2 < share_.size()) ++i;
  const double rise = share_[i + 1] - share_[i];
  const double fraction = rise > 0 ? (share - share_[i]) / rise : 0;
  return std::sqrt(sin2_half_[i] + fraction * (sin2_half_[i + 1] - sin2_half_[i]));
}

}  // namespace albtpu
