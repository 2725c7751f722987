#include "sea/sampled_spectrum.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

namespace albtpu {
namespace {

constexpr int kDirections = 96;  // of the half turn after which a spreading repeats

double Direction(int j) { return std::numbers::pi * (j + 0.5) / kDirections; }

// The coefficients of the exponent for which the harmonics are `harmonics`, cosines first.
//
// They minimize log(mean of exp(c . f)) - c . harmonics, where f are the cosines and sines: the gradient is the
// difference of the harmonics, and the Hessian is the covariance of f, so that the function is convex. Densities that
// have more than kMostInOneDirection of their waves in one of kDirections are too narrow for these directions and count
// as infinitely high. The small ridge keeps the Hessian regular.
Eigen::VectorXd Exponent(const Eigen::VectorXd& harmonics, const Eigen::MatrixXd& functions) {
  constexpr double kRidge = 1e-7, kExact = 1e-10, kMostInOneDirection = 0.25;
  constexpr int kMaxSteps = 50;
  constexpr double kShortestStep = 1e-6;
  const auto exponentials = [&](const Eigen::VectorXd& c, double& greatest) -> Eigen::VectorXd {
    const Eigen::VectorXd exponents = functions * c;
    greatest = exponents.maxCoeff();
    return (exponents.array() - greatest).exp().matrix();
  };
  const auto objective = [&](const Eigen::VectorXd& c) {
    double greatest = 0;
    const double sum = exponentials(c, greatest).sum();
    if (1 > kMostInOneDirection * sum) return std::numeric_limits<double>::infinity();
    return greatest + std::log(sum) - c.dot(harmonics) + 0.5 * kRidge * c.squaredNorm();
  };
  Eigen::VectorXd c = Eigen::VectorXd::Zero(harmonics.size());
  for (int step = 0; step < kMaxSteps; ++step) {  // Newton's method
    double greatest = 0;
    Eigen::VectorXd density = exponentials(c, greatest);
    density /= density.sum();
    const Eigen::VectorXd means = functions.transpose() * density;
    const Eigen::VectorXd gradient = means - harmonics + kRidge * c;
    if (gradient.cwiseAbs().maxCoeff() < kExact) break;
    Eigen::MatrixXd hessian = functions.transpose() * density.asDiagonal() * functions - means * means.transpose();
    hessian.diagonal().array() += kRidge;
    const Eigen::VectorXd newton = -hessian.ldlt().solve(gradient);
    const double before = objective(c), slope = gradient.dot(newton);
    double length = 1;
    while (length > kShortestStep && !(objective(c + length * newton) <= before + 1e-4 * length * slope)) length /= 2;
    if (length <= kShortestStep) break;  // at the precision of the objective, or at the narrowest density
    c += length * newton;
  }
  return c;
}

}  // namespace

PositiveSpreading::PositiveSpreading(const std::vector<double>& a, const std::vector<double>& b)
    : cosine_(a), sine_(b) {
  assert(!a.empty() && a.size() == b.size());
  for (double& each : cosine_) each *= 2;
  for (double& each : sine_) each *= 2;
  double least = 1;
  for (int j = 0; j < kDirections; ++j) least = std::min(least, (*this)(Direction(j)));
  if (least >= 0) return;

  Eigen::Index n = static_cast<Eigen::Index>(a.size());
  while (n > 1 && a[n - 1] == 0 && b[n - 1] == 0) --n;
  Eigen::VectorXd harmonics(2 * n);
  Eigen::MatrixXd functions(kDirections, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    harmonics[i] = a[i];
    harmonics[n + i] = b[i];
    for (int j = 0; j < kDirections; ++j) {
      const double angle = 2 * static_cast<double>(i + 1) * Direction(j);
      functions(j, i) = std::cos(angle);
      functions(j, n + i) = std::sin(angle);
    }
  }
  const Eigen::VectorXd exponent = Exponent(harmonics, functions);
  const Eigen::VectorXd exponents = functions * exponent;
  const double greatest = exponents.maxCoeff();
  exponential_ = true;
  constant_ = -greatest - std::log((exponents.array() - greatest).exp().mean());
  cosine_.assign(exponent.data(), exponent.data() + n);
  sine_.assign(exponent.data() + n, exponent.data() + 2 * n);
}

double PositiveSpreading::operator()(double psi) const {
  const std::complex<double> turn = std::polar(1.0, 2 * psi);
  std::complex<double> wave = 1;
  double series = constant_;
  for (std::size_t n = 0; n < cosine_.size(); ++n) {
    wave *= turn;
    series += cosine_[n] * wave.real() + sine_[n] * wave.imag();
  }
  return (exponential_ ? std::exp(series) : series) / (2 * std::numbers::pi);
}

namespace {

// The range of samples outside of which lies at most half of 1e-4 of the elevation variance and of the slope variance
// on either side; all of them for a sea without waves.
WavenumberRange EnergeticRange(const std::vector<double>& k, const std::vector<double>& s) {
  constexpr double kLeftOut = 0.5e-4;
  std::vector<double> elevation(k.size()), slope(k.size());  // of all waves up to each sample
  for (std::size_t i = 1; i < k.size(); ++i) {
    const double below = 0.5 * (k[i] - k[i - 1]) * s[i - 1], above = 0.5 * (k[i] - k[i - 1]) * s[i];
    elevation[i] = elevation[i - 1] + below + above;
    slope[i] = slope[i - 1] + below * k[i - 1] * k[i - 1] + above * k[i] * k[i];
  }
  std::size_t first = 0, last = k.size() - 1;
  while (first + 1 < last && elevation[first + 1] < kLeftOut * elevation.back() &&
         slope[first + 1] < kLeftOut * slope.back())
    ++first;
  while (last > first + 1 && elevation[last - 1] > (1 - kLeftOut) * elevation.back() &&
         slope[last - 1] > (1 - kLeftOut) * slope.back())
    --last;
  return {k[first], k[last]};
}

}  // namespace

SampledSpectrum::SampledSpectrum(const HarmonicSpectrum& spectrum, SpectrumText text)
    : range_(EnergeticRange(spectrum.k, spectrum.s)), text_(std::move(text)) {
  assert(spectrum.size() >= 2);
  std::vector<double> a(spectrum.harmonics()), b(spectrum.harmonics());
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    log_k_.push_back(std::log(spectrum.k[i]));
    saturation_.push_back(std::pow(spectrum.k[i], 3) * spectrum.s[i]);
    for (std::size_t n = 0; n < a.size(); ++n) {
      a[n] = spectrum.s[i] > 0 ? spectrum.a[n][i] : 0;
      b[n] = spectrum.s[i] > 0 ? spectrum.b[n][i] : 0;
    }
    spreading_.emplace_back(a, b);
  }
}

SampledSpectrum::Between SampledSpectrum::Find(double k) const {
  const double log_k = std::log(k);
  if (log_k < log_k_.front() || log_k > log_k_.back()) return {0, 0, 0};
  const auto above = std::upper_bound(log_k_.begin() + 1, log_k_.end() - 1, log_k);
  const auto at = static_cast<std::size_t>(above - log_k_.begin()) - 1;
  const double t = (log_k - log_k_[at]) / (log_k_[at + 1] - log_k_[at]);
  return {at, (1 - t) * saturation_[at], t * saturation_[at + 1]};
}

double SampledSpectrum::operator()(double k) const {
  const Between here = Find(k);
  return (here.first + here.second) / (k * k * k);
}

double SampledSpectrum::Spreading(double k, double psi) const {
  const auto [at, first, second] = Find(k);
  if (!(first + second > 0)) return 1 / (2 * std::numbers::pi);
  return (first * spreading_[at](psi) + second * spreading_[at + 1](psi)) / (first + second);
}

double SampledSpectrum::peak_wavenumber() const {
  const auto energy = [&](std::size_t i) { return saturation_[i] * std::exp(-2 * log_k_[i]); };  // k S(k)
  std::size_t peak = 0;
  for (std::size_t i = 1; i < log_k_.size(); ++i)
    if (energy(i) > energy(peak)) peak = i;
  return std::exp(log_k_[peak]);
}

}  // namespace albtpu
