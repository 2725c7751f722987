#include "generator/surface/long_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace albtpu {
namespace {

// Rings are narrow where the footprint sees more of a wave than a tilt, and wider for longer waves.
constexpr double kNarrowRing = 1.39;  // ratio of the outer to the inner wavenumber
constexpr double kWideRing = 2.89;
constexpr int kNarrowRings = 6;
// Of the half plane. A sum over equidistant directions is exact for harmonics below 2 kDirections: those of the
// spreading, two more for the product of two slopes, and the few of the footprint's average.
constexpr int kDirections = 12;

// Gauss-Legendre nodes and weights of four points on (-1, 1); Abramowitz and Stegun, table 25.4.
constexpr std::array<double, 4> kGaussNodes = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                               0.861136311594053};
constexpr std::array<double, 4> kGaussWeights = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                                 0.347854845137454};
constexpr int kPanels = 8;  // of each ring, because the spectral peak of a young sea is narrow

LongWaveModel::Wave WaveOfSlope(double log_k, double psi, double slope_variance) {
  const double k = std::exp(log_k);
  return {{k * std::cos(psi), k * std::sin(psi)}, slope_variance / (k * k)};
}

// Two waves for the waves of a ring that travel towards `psi` or back, `d_psi` wide. Their slope variance over ln k has
// the first four moments of the ring's: they are the nodes of Gauss's quadrature of two points with the slope variance
// as the weight. The mean of any cubic in ln k over the ring is thus exact.
std::array<LongWaveModel::Wave, 2> RingWaves(const SeaState& sea, const CrossFade& patch_share,
                                             double k_inner, double k_outer, double psi, double d_psi) {
  std::array<double, 4 * kPanels> log_k, slope;
  const double panel = std::log(k_outer / k_inner) / kPanels;
  for (int i = 0; i < 4 * kPanels; ++i) {
    log_k[i] = std::log(k_inner) + panel * (i / 4 + 0.5 + 0.5 * kGaussNodes[i % 4]);
    const double k = std::exp(log_k[i]);
    slope[i] = 2 * d_psi * 0.5 * panel * kGaussWeights[i % 4] * k * k * k * sea.S(k) * (1 - patch_share(k)) *
               sea.FrozenSpreading(k, psi);
  }
  const double total = std::accumulate(slope.begin(), slope.end(), 0.0);
  if (total == 0) return {WaveOfSlope(std::log(k_inner), psi, 0), WaveOfSlope(std::log(k_outer), psi, 0)};
  const auto moment = [&](int power, double about) {
    double sum = 0;
    for (int i = 0; i < 4 * kPanels; ++i) sum += slope[i] * std::pow(log_k[i] - about, power);
    return sum / total;
  };
  const double mean = moment(1, 0), second = moment(2, mean), third = moment(3, mean);
  // The roots of x^2 - third / second x - second = 0, the polynomial orthogonal to 1 and x about the mean.
  const double lean = 0.5 * third / second, root = std::sqrt(lean * lean + second);
  const double below = lean - root, above = lean + root;
  const double share_below = above / (above - below);
  return {WaveOfSlope(mean + below, psi, share_below * total),
          WaveOfSlope(mean + above, psi, (1 - share_below) * total)};
}

}  // namespace

LongWaveModel::LongWaveModel(const SeaState& sea, const CrossFade& patch_share) {
  const double lowest = sea.energetic_range().lowest;
  const double d_psi = std::numbers::pi / kDirections;
  double outer = patch_share.all_patch();
  for (int ring = 0; outer > lowest; ++ring) {
    const double inner = std::max(lowest, outer / (ring < kNarrowRings ? kNarrowRing : kWideRing));
    for (int direction = 0; direction < kDirections; ++direction) {
      const auto pair = RingWaves(sea, patch_share, inner, outer, (direction + 0.5) * d_psi, d_psi);
      waves_.insert(waves_.end(), pair.begin(), pair.end());
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
  constexpr int kMaxSteps = 50;
  constexpr double kCloseEnough = 1e-9;  // m
  double z = 0;
  for (int step = 0; step < kMaxSteps; ++step) {  // Newton's method
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
