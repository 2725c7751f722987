#include "generator/surface/long_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// Rings are narrow where the footprint sees more of a wave than a tilt, and wider for longer waves. Still narrower
// rings change the slope variance within a footprint by less than 0.2 %.
constexpr double kNarrowRing = 1.18;  // ratio of the outer to the inner wavenumber
constexpr double kWideRing = 1.7;
constexpr int kNarrowRings = 12;
constexpr int kSectors = 12;  // of the half plane

// Gauss-Legendre nodes and weights of four points on (-1, 1); Abramowitz and Stegun, table 25.4.
constexpr std::array<double, 4> kGaussNodes = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                               0.861136311594053};
constexpr std::array<double, 4> kGaussWeights = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                                 0.347854845137454};
constexpr int kPanels = 4;  // of each ring, because the spectral peak of a young sea is narrow

// One wave with the variances of elevation and slope of a cell: a ring and a sector of the half plane, together with
// their mirror image. Its wavenumber is the square root of the ratio of the two variances.
LongWaveModel::Wave CellWave(const SeaState& sea, const CrossFade& patch_share, double k_inner,
                             double k_outer, double psi, double d_psi) {
  double elevation = 0, slope = 0;
  const double panel = std::log(k_outer / k_inner) / kPanels;
  for (int p = 0; p < kPanels; ++p) {
    for (int a = 0; a < 4; ++a) {
      const double k = k_inner * std::exp(panel * (p + 0.5 + 0.5 * kGaussNodes[a]));
      const double ring = 0.5 * panel * kGaussWeights[a] * k * sea.S(k) * (1 - patch_share(k));
      for (int b = 0; b < 4; ++b) {
        const double direction = psi + 0.5 * d_psi * kGaussNodes[b];
        const double power = 2 * ring * 0.5 * d_psi * kGaussWeights[b] * sea.FrozenSpreading(k, direction);
        elevation += power;
        slope += power * k * k;
      }
    }
  }
  const double k = elevation > 0 ? std::sqrt(slope / elevation) : k_outer;
  return {{k * std::cos(psi), k * std::sin(psi)}, elevation};
}

}  // namespace

LongWaveModel::LongWaveModel(const SeaState& sea, const CrossFade& patch_share) {
  const double lowest = sea.energetic_range().lowest;
  const double d_psi = std::numbers::pi / kSectors;
  double outer = patch_share.all_patch();
  for (int ring = 0; outer > lowest; ++ring) {
    const double inner = std::max(lowest, outer / (ring < kNarrowRings ? kNarrowRing : kWideRing));
    for (int sector = 0; sector < kSectors; ++sector) {
      waves_.push_back(CellWave(sea, patch_share, inner, outer, (sector + 0.5) * d_psi, d_psi));
    }
    outer = inner;
  }
}

double LongWaveModel::elevation_variance() const {
  double sum = 0;
  for (const Wave& wave : waves_) sum += wave.variance;
  return sum;
}

Eigen::Matrix2d LongWaveModel::SlopeCovariance(
    const std::function<double(double k, double psi)>& weight) const {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Wave& wave : waves_) {
    const double psi = std::atan2(wave.wavenumber.y(), wave.wavenumber.x());
    sum +=
        wave.variance * weight(wave.wavenumber.norm(), psi) * wave.wavenumber * wave.wavenumber.transpose();
  }
  return sum;
}

Eigen::VectorXcd LongWaveModel::Draw(NormalStream& stream) const {
  std::vector<double> normals(2 * waves_.size());
  stream.Fill(normals);
  Eigen::VectorXcd amplitudes(waves_.size());
  for (std::size_t m = 0; m < waves_.size(); ++m) {
    amplitudes[m] = std::sqrt(waves_[m].variance) * std::complex<double>(normals[2 * m], normals[2 * m + 1]);
  }
  return amplitudes;
}

Eigen::VectorXcd LongWaveModel::Shifted(const Eigen::VectorXcd& amplitudes,
                                        const Eigen::Vector2d& origin) const {
  Eigen::VectorXcd shifted(amplitudes.size());
  for (std::size_t m = 0; m < waves_.size(); ++m) {
    shifted[m] = amplitudes[m] * std::polar(1.0, waves_[m].wavenumber.dot(origin));
  }
  return shifted;
}

// Two products of real matrices: Eigen computes them faster than a complex product, whose imaginary part is not needed.
Eigen::MatrixXd SumOfWaves(const Eigen::MatrixXcd& phases_x, const Eigen::VectorXcd& amplitudes,
                           const Eigen::MatrixXcd& phases_y) {
  const Eigen::MatrixXcd weighted = phases_x * amplitudes.asDiagonal();
  return weighted.real() * phases_y.real().transpose() - weighted.imag() * phases_y.imag().transpose();
}

double HeightOfIntersection(const LongWaveModel& model, const Eigen::VectorXcd& amplitudes,
                            const Eigen::Vector2d& at_zero, const Eigen::Vector2d& per_height) {
  constexpr int kMostSteps = 50;
  constexpr double kCloseEnough = 1e-9;  // m
  double z = 0;
  for (int step = 0; step < kMostSteps; ++step) {  // Newton's method
    const Eigen::VectorXcd here = model.Shifted(amplitudes, at_zero + z * per_height);
    double height = 0, height_per_z = 0;
    for (std::size_t m = 0; m < model.waves().size(); ++m) {
      height += here[m].real();
      height_per_z -= model.waves()[m].wavenumber.dot(per_height) * here[m].imag();
    }
    const double change = (height - z) / (1 - height_per_z);
    z += change;
    if (std::abs(change) < kCloseEnough) break;
  }
  return z;
}

}  // namespace albtpu
