#include "sea/response/beam_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// Harmonics that the stretching adds to those of the sea. Each is smaller than the one before by some
// tan^2(incidence) / 4, 0.05 at 25 degrees.
constexpr int kAddedHarmonics = 2;

}  // namespace

SlopeSpectrum::SlopeSpectrum(const HarmonicSpectrum& spectrum)
    : harmonics_(std::min<int>(spectrum.harmonics(), HankelLattice::kOrders / 2 - 1 - kAddedHarmonics)) {
  assert(spectrum.size() >= 2);
  const HankelLattice& lattice = HankelLattice::Shared();
  power_ = Eigen::MatrixXd::Zero(lattice.size(), 2 * harmonics_ + 1);
  std::size_t next = 0;  // the first sample above k
  for (int i = 0; i < lattice.size(); ++i) {
    const double k = lattice.wavenumbers()[i];
    while (next < spectrum.size() && spectrum.k[next] <= k) ++next;
    if (next == 0 || (next == spectrum.size() && spectrum.k.back() < k)) continue;
    const std::size_t after = std::min(next, spectrum.size() - 1), before = after - 1;
    const double fraction = (k - spectrum.k[before]) / (spectrum.k[after] - spectrum.k[before]);
    const double s_before = (1 - fraction) * spectrum.s[before], s_after = fraction * spectrum.s[after];
    const double scale = lattice.step() * k * k * k / (2 * kPi);
    power_(i, 0) = scale * (s_before + s_after);
    for (int n = 1; n <= harmonics_; ++n) {
      const std::vector<double>&a = spectrum.a[n - 1], &b = spectrum.b[n - 1];
      power_(i, 2 * n - 1) = 2 * scale * (s_before * a[before] + s_after * a[after]);
      power_(i, 2 * n) = 2 * scale * (s_before * b[before] + s_after * b[after]);
    }
  }
}

Eigen::Matrix2d SlopeSpectrum::Covariance() const {
  const Eigen::VectorXd sums = power_.colwise().sum();
  const double half_trace = kPi * sums[0];
  const double half_difference = kPi / 2 * sums[1], xy = kPi / 2 * sums[2];
  return (Eigen::Matrix2d() << half_trace + half_difference, xy, xy, half_trace - half_difference).finished();
}

BeamSpectrum SlopeSpectrum::AcrossBeam(double incidence, double azimuth) const {
  const Eigen::Index size = power_.rows();
  const int kept = harmonics_ + kAddedHarmonics;
  // Of half a turn. Harmonics that the stretching makes beyond four more than those of the sea alias: 1e-5 of them.
  const int directions = harmonics_ + kept + 5;
  const double cosine = std::cos(incidence);
  // exp(-2 i m psi) d(psi), and the density in kappa.
  Eigen::MatrixXcd transform(directions, kept + 1);
  Eigen::MatrixXd angles(2 * harmonics_ + 1, directions);
  Eigen::ArrayXd shift(directions);
  for (int j = 0; j < directions; ++j) {
    const double psi = kPi * (j + 0.5) / directions;
    const double along = cosine * std::cos(psi), across = std::sin(psi);
    const double ratio = std::hypot(along, across);  // k / kappa
    shift[j] = -std::log(ratio) / HankelLattice::Shared().step();
    const double on_water = azimuth + std::atan2(across, along);
    angles(0, j) = 1;
    for (int n = 1; n <= harmonics_; ++n) {
      angles(2 * n - 1, j) = std::cos(2 * n * on_water);
      angles(2 * n, j) = std::sin(2 * n * on_water);
    }
    // P in d(ln kappa) d(psi) is cos(incidence) / ratio^2 times that in d(ln k) d(direction on the water), and
    // kappa^2 = k^2 / ratio^2.
    const double density = cosine / std::pow(ratio, 4) * 2 * kPi / directions;
    for (int m = 0; m <= kept; ++m) transform(j, m) = std::polar(density, -2 * m * psi);
  }
  const Eigen::MatrixXd on_water = power_ * angles;
  Eigen::MatrixXd across_beam = Eigen::MatrixXd::Zero(size, directions);
  for (int j = 0; j < directions; ++j) {
    // Cubic interpolation between the four samples at k / kappa steps before.
    const int whole = static_cast<int>(shift[j]);
    const double t = shift[j] - whole;
    const double weights[] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                              -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    for (int i = 0; i < 4; ++i) {
      const Eigen::Index behind = whole + i - 1;
      const Eigen::Index to = std::max<Eigen::Index>(behind, 0), from = std::max<Eigen::Index>(-behind, 0);
      const Eigen::Index count = size - std::max(to, from);
      across_beam.col(j).segment(to, count) += weights[i] * on_water.col(j).segment(from, count);
    }
  }
  return {incidence, across_beam * transform};
}

}  // namespace albtpu
