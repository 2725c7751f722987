#include "sea/correlation/moving_waves.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "sea/correlation/cell_window.h"
#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/slope_covariance.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

constexpr int kLast = WaveHarmonics::kLast;
static_assert(kLast + 1 == HankelLattice::kOrders);

// The steps of the phase of a wave within a step of the lattice: rad, and how many at most. Waves whose phase turns
// faster have no part in a covariance; the Bessel functions of so many radians, some 150, are below 0.07.
constexpr double kPhaseStep = 0.8;
constexpr int kMostSteps = 10;

double DirectionOf(int j, int count) { return std::numbers::pi * (j + 0.5) / count; }  // of the half plane

using Orders = std::array<double, kLast + 1>;

// J_0 to J_kLast.
void BesselOrders(double z, Orders& j) {
  if (z < 0.1) {  // two terms of the series
    const double half = z / 2, q = half * half;
    double power = 1;
    for (int p = 0; p <= kLast; ++p) {
      j[p] = power * (1 - q / (p + 1) * (1 - q / (2 * (p + 2))));
      power *= half / (p + 1);
    }
    return;
  }
  if (z > kLast) {  // where recurrence upwards keeps its digits
    j[0] = ::j0(z);
    j[1] = ::j1(z);
    for (int p = 1; p < kLast; ++p) j[p + 1] = 2 * p / z * j[p] - j[p - 1];
    return;
  }
  // Miller's recurrence downwards, from an order beyond which all are below 1e-12, and J_0 + 2 J_2 + 2 J_4 + ... = 1.
  constexpr int kFirst = 44;
  double above = 0, here = 1e-200, sum = 0;
  for (int p = kFirst; p > 0; --p) {
    const double below = 2 * p / z * here - above;
    above = here;
    here = below;
    if (p - 1 <= kLast) j[p - 1] = here;
    if ((p - 1) % 2 == 0) sum += p == 1 ? here : 2 * here;
  }
  for (double& value : j) value /= sum;
}

Eigen::Matrix2d SlopesOf(double sum, double cosine, double sine) {
  return (Eigen::Matrix2d() << (sum + cosine) / 2, sine / 2, sine / 2, (sum - cosine) / 2).finished();
}

}  // namespace

MovingWaves::MovingWaves(const HarmonicSpectrum& spectrum, const WaveMotion& motion) : motion_(motion) {
  // At nadir the coordinates across the beam are those of the water.
  const BeamSpectrum on_water = SlopeSpectrum(spectrum).AcrossBeam(0, 0);
  const int harmonics = on_water.harmonics();
  Eigen::MatrixXd turns(2 * harmonics + 2, kDirections);
  for (int j = 0; j < kDirections; ++j) {
    for (int m = 0; m <= harmonics; ++m) {
      const double factor = (m == 0 ? 1 : 2) / (2 * std::numbers::pi), angle = 2 * m * DirectionOf(j, kDirections);
      turns(2 * m, j) = factor * std::cos(angle);
      turns(2 * m + 1, j) = -factor * std::sin(angle);
    }
  }
  Eigen::MatrixXd parts(on_water.slope.rows(), 2 * harmonics + 2);
  for (int m = 0; m <= harmonics; ++m) {
    parts.col(2 * m) = on_water.slope.col(m).real();
    parts.col(2 * m + 1) = on_water.slope.col(m).imag();
  }
  power_ = parts * turns;
}

WaveHarmonics MovingWaves::Weighted(const Eigen::MatrixXd& weights) const {
  // Two more for the products with cos(2 psi) and sin(2 psi). The factor of exp(i n psi) is the mean over the half
  // plane, where the odd part of the spectrum is the even one times that of the travel.
  constexpr int kCount = kLast + 3;
  Eigen::MatrixXd turns(kDirections, 2 * kCount);
  for (int j = 0; j < kDirections; ++j) {
    const double psi = DirectionOf(j, kDirections), c = std::cos(psi - motion_.towards);
    const double odd = motion_.travel == WaveTravel::kBothWays ? 0 : 2 * c / (1 + c * c);
    for (int n = 0; n < kCount; ++n) {
      const double factor = (n % 2 == 0 ? 1 : odd) / kDirections;
      turns(j, 2 * n) = factor * std::cos(n * psi);
      turns(j, 2 * n + 1) = -factor * std::sin(n * psi);
    }
  }
  Eigen::MatrixXd weighted = power_;
  if (weights.cols() == 1)
    weighted.array().colwise() *= weights.col(0).array();
  else
    weighted.array() *= weights.array();
  const Eigen::MatrixXd parts = weighted * turns;
  Eigen::MatrixXcd all(parts.rows(), kCount);
  for (int n = 0; n < kCount; ++n) {
    all.col(n).real() = parts.col(2 * n);
    all.col(n).imag() = parts.col(2 * n + 1);
  }
  return WaveHarmonics(std::move(all));
}

Eigen::ArrayXcd WaveHarmonics::cosine(int n) const {
  if (n >= 2) return (sum(n - 2) + sum(n + 2)) / 2;
  return (sum(2 - n).conjugate() + sum(n + 2)) / 2;
}

Eigen::ArrayXcd WaveHarmonics::sine(int n) const {
  const std::complex<double> half(0, -0.5);
  if (n >= 2) return (sum(n - 2) - sum(n + 2)) * half;
  return (sum(2 - n).conjugate() - sum(n + 2)) * half;
}

FootprintWaves MovingWaves::AtPoints() const { return {Weighted(Eigen::MatrixXd::Ones(power_.rows(), 1)), motion_}; }

// A wave of wavenumber k on the water has ratio k across the beam, where the footprint is a circle.
FootprintWaves MovingWaves::Under(const BeamOptions& beam) const {
  const HankelLattice& lattice = HankelLattice::Shared();
  const int size = lattice.size();
  Eigen::ArrayXd average(size);
  for (int i = 0; i < size; ++i)
    average[i] = FootprintAverage({.footprint = beam.footprint, .profile = beam.profile}, lattice.wavenumbers()[i], 0);
  if (beam.incidence == 0) return {Weighted(average.square().matrix()), motion_};
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(size, kDirections);
  for (int j = 0; j < kDirections; ++j) {
    const double psi = DirectionOf(j, kDirections) - beam.azimuth;
    const double steps = std::log(std::hypot(std::cos(psi) / std::cos(beam.incidence), std::sin(psi))) / lattice.step();
    const int whole = static_cast<int>(steps);
    const double t = steps - whole;
    // Cubic interpolation between the four samples about it.
    const double shares[] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                             (t + 1) * t * (t - 1) / 6};
    for (int n = 0; n < 4; ++n) {
      const int ahead = whole + n - 1, to = std::max(0, -ahead), from = std::max(0, ahead);
      const int count = size - std::max(to, from);
      weights.col(j).segment(to, count) += shares[n] * average.matrix().segment(from, count);
    }
  }
  return {Weighted(weights.array().square().matrix()), motion_};
}

WaveCovariance FootprintWaves::Whole() const { return AtDistance(0, 0).Towards(0); }

WaveCovariance FootprintWaves::Between(const Eigen::Vector2d& apart, double later) const {
  return AtDistance(apart.norm(), later).Towards(apart.isZero(0) ? 0 : std::atan2(apart.y(), apart.x()));
}

// With z = k |apart| and the direction beta of `apart`, the integral over psi of F cos(z cos(psi - beta) - omega later)
// is 2 pi times the sum over n of J_n(z) Re(i^n f_n exp(i n beta) exp(-i omega later)), where n and -n add alike.
WavesAtDistance FootprintWaves::AtDistance(double distance, double later) const {
  const HankelLattice& lattice = HankelLattice::Shared();
  const int size = lattice.size();
  constexpr int kCount = kLast + 1;
  const bool whole = distance == 0 && later == 0;
  // J_n(z) cos(omega later), or sine where n is odd, integrated over each step of the lattice: by n and wavenumber.
  Eigen::ArrayXXd kernels = Eigen::ArrayXXd::Zero(kCount, size);
  if (whole) kernels.row(0).setOnes();
  const double time = std::abs(later);
  Orders orders;
  for (int i = 0; i + 1 < size && !whole; ++i) {
    const double k = lattice.wavenumbers()[i];
    // Twice the frequency changes 3 times as fast as k at most.
    const double phase = lattice.step() * (k * distance + 1.5 * AngularFrequency(k, motion_.water_depth) * time);
    if (phase > kMostSteps * kPhaseStep) break;
    const int steps = std::max(1, static_cast<int>(std::ceil(phase / kPhaseStep)));
    for (int step = 0; step < steps; ++step) {
      const double u = (step + 0.5) / steps, here = k * std::exp(lattice.step() * u);
      BesselOrders(here * distance, orders);
      const double angle = AngularFrequency(here, motion_.water_depth) * time;
      const double cosine = std::cos(angle) / steps, sine = std::sin(angle) / steps;
      for (int n = 0; n < kCount; ++n) {
        const double value = orders[n] * (n % 2 == 0 ? cosine : sine);
        kernels(n, i) += (1 - u) * value;
        kernels(n, i + 1) += u * value;
      }
    }
  }
  WavesAtDistance waves;
  for (int n = 0; n < (whole ? 1 : kCount); ++n) {
    const double sign = n % 4 < 2 ? 1 : -1, factor = 2 * std::numbers::pi * (n == 0 ? 1 : 2) * sign;
    // A negative `later` turns the sine, which odd orders have.
    const Eigen::ArrayXd kernel = (n % 2 == 1 && later < 0 ? -factor : factor) * kernels.row(n).transpose();
    const std::complex<double> totals[] = {(harmonics_.sum(n) * kernel).sum(), (harmonics_.cosine(n) * kernel).sum(),
                                           (harmonics_.sine(n) * kernel).sum(),
                                           (harmonics_.sum(n) * kernel / lattice.wavenumbers().square()).sum()};
    for (int each = 0; each < 4; ++each) {
      waves.factors_(n, 2 * each) = totals[each].real();
      waves.factors_(n, 2 * each + 1) = totals[each].imag();
    }
  }
  return waves;
}

WaveCovariance WavesAtDistance::Towards(double direction) const {
  Eigen::Array<double, 4, 1> totals = Eigen::Array<double, 4, 1>::Zero();
  const std::complex<double> step = std::polar(1.0, direction);
  std::complex<double> turn = 1;
  for (int n = 0; n <= kLast; ++n) {
    for (int each = 0; each < 4; ++each)
      totals[each] += factors_(n, 2 * each) * turn.real() - factors_(n, 2 * each + 1) * turn.imag();
    turn *= step;
  }
  return {SlopesOf(totals[0], totals[1], totals[2]), totals[3]};
}

WaveCovariance FootprintWaves::InCell(const SurfaceCell& cell) const {
  const Eigen::ArrayXXd window = CellWindowOf(cell.side);
  Eigen::ArrayXXd weights(window.rows(), 2 * window.cols());  // of the real and the imaginary part
  for (Eigen::Index m = 0; m < window.cols(); ++m) {
    const double factor = 2 * std::numbers::pi * (m == 0 ? 1 : 2),
                 angle = 4 * static_cast<double>(m) * cell.orientation;
    weights.col(2 * m) = factor * std::cos(angle) * window.col(m);
    weights.col(2 * m + 1) = -factor * std::sin(angle) * window.col(m);
  }
  const auto power = [&](const auto& harmonic) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(window.rows());
    for (int m = 0; m < window.cols(); ++m) {
      const Eigen::ArrayXcd factors = harmonic(4 * m);
      sum += weights.col(2 * m) * factors.real() + weights.col(2 * m + 1) * factors.imag();
    }
    return sum;
  };
  const Eigen::ArrayXd sum = power([this](int n) { return harmonics_.sum(n); });
  const double cosine = power([this](int n) { return harmonics_.cosine(n); }).sum();
  const double sine = power([this](int n) { return harmonics_.sine(n); }).sum();
  return {SlopesOf(sum.sum(), cosine, sine), (sum / HankelLattice::Shared().wavenumbers().square()).sum()};
}

}  // namespace albtpu
