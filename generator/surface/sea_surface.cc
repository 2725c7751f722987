#include "generator/surface/sea_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "generator/math/fft.h"

namespace albtpu {
namespace {

// Rings are narrow where the footprint sees more of a wave than a tilt, and wider for longer waves.
constexpr double kNarrowRing = 1.39;  // ratio of the outer to the inner wavenumber
constexpr double kWideRing = 2.89;
constexpr int kNarrowRings = 6;
// Directions of the half plane, at least. A sum over N equidistant directions is exact for harmonics below 2 N: those
// of the spreading, and kMoreHarmonics for the product of two slopes and the footprint's average.
constexpr int kFewestDirections = 12;
constexpr int kMoreHarmonics = 10;
// The directions by which the harmonics of a ring are found. They resolve every PositiveSpreading.
constexpr int kFineDirections = 96;

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

// The waves of a ring at nodes over ln k: their slope variance within `d_psi` over their spreading.
struct Ring {
  std::array<double, 4 * kPanels> log_k, k, slope;
};

Ring RingOf(const SeaState& sea, const CrossFade& patch_share, double k_inner, double k_outer, double d_psi) {
  Ring ring;
  const double panel = std::log(k_outer / k_inner) / kPanels;
  for (int i = 0; i < 4 * kPanels; ++i) {
    ring.log_k[i] = std::log(k_inner) + panel * (i / 4 + 0.5 + 0.5 * kGaussNodes[i % 4]);
    const double k = ring.k[i] = std::exp(ring.log_k[i]);
    ring.slope[i] = 2 * d_psi * 0.5 * panel * kGaussWeights[i % 4] * k * k * k * sea.S(k) * (1 - patch_share(k));
  }
  return ring;
}

// So many directions that the ring's last harmonic of at least 1e-3 of its slope is summed exactly. The spreading has
// even harmonics alone: a wave on a frozen surface looks the same as one that travels the opposite way.
int DirectionsOf(const SeaState& sea, const Ring& ring) {
  constexpr double kNegligible = 1e-3;
  constexpr double kStep = std::numbers::pi / kFineDirections;
  std::array<double, kFineDirections> slope{};
  for (int j = 0; j < kFineDirections; ++j)
    for (int i = 0; i < 4 * kPanels; ++i) slope[j] += ring.slope[i] * sea.FrozenSpreading(ring.k[i], (j + 0.5) * kStep);
  const double total = std::accumulate(slope.begin(), slope.end(), 0.0);
  const auto matters = [&](int harmonic) {
    std::complex<double> sum = 0;
    for (int j = 0; j < kFineDirections; ++j) sum += std::polar(slope[j], harmonic * (j + 0.5) * kStep);
    return std::abs(sum) > kNegligible * total;
  };
  int last = kFineDirections - 2;
  while (last + kMoreHarmonics > 2 * kFewestDirections && !matters(last)) last -= 2;
  return (last + kMoreHarmonics) / 2;
}

// Two waves for the waves of a ring that travel towards `psi` or back, in one of its directions. Their slope variance
// over ln k has the first four moments of the ring's: they are the nodes of Gauss's quadrature of two points with the
// slope variance as the weight. The mean of any cubic in ln k over the ring is thus exact.
std::array<LongWaveModel::Wave, 2> RingWaves(const SeaState& sea, const Ring& ring, double psi) {
  const std::array<double, 4 * kPanels>& log_k = ring.log_k;
  std::array<double, 4 * kPanels> slope;
  for (int i = 0; i < 4 * kPanels; ++i) slope[i] = ring.slope[i] * sea.FrozenSpreading(ring.k[i], psi);
  const double total = std::accumulate(slope.begin(), slope.end(), 0.0);
  if (total == 0) return {WaveOfSlope(log_k.front(), psi, 0), WaveOfSlope(log_k.back(), psi, 0)};
  const auto moment = [&](int power, double about) {
    double sum = 0;
    for (int i = 0; i < 4 * kPanels; ++i) sum += slope[i] * std::pow(log_k[i] - about, power);
    return sum / total;
  };
  const double mean = moment(1, 0), second = moment(2, mean), third = moment(3, mean);
  if (second == 0) return {WaveOfSlope(mean, psi, total), WaveOfSlope(mean, psi, 0)};  // All is at one node.
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
  double outer = patch_share.all_patch();
  for (int ring = 0; outer > lowest; ++ring) {
    const double inner = std::max(lowest, outer / (ring < kNarrowRings ? kNarrowRing : kWideRing));
    const int directions = DirectionsOf(sea, RingOf(sea, patch_share, inner, outer, 1));
    const double d_psi = std::numbers::pi / directions;
    const Ring of_direction = RingOf(sea, patch_share, inner, outer, d_psi);
    for (int direction = 0; direction < directions; ++direction) {
      const auto pair = RingWaves(sea, of_direction, (direction + 0.5) * d_psi);
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

Eigen::Matrix2d LongWaveModel::SlopeCovariance(const std::function<double(double k, double psi)>& weight) const {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Wave& wave : waves_) {
    const double psi = std::atan2(wave.wavenumber.y(), wave.wavenumber.x());
    sum += wave.variance * weight(wave.wavenumber.norm(), psi) * wave.wavenumber * wave.wavenumber.transpose();
  }
  return sum;
}

Eigen::VectorXcd LongWaveModel::Draw(NormalStream& stream) const {
  std::vector<double> normals(2 * waves_.size());
  stream.Fill(normals);
  Eigen::VectorXcd amplitudes(waves_.size());
  for (std::size_t m = 0; m < waves_.size(); ++m)
    amplitudes[m] = std::sqrt(waves_[m].variance) * std::complex<double>(normals[2 * m], normals[2 * m + 1]);
  return amplitudes;
}

Eigen::VectorXcd LongWaveModel::Shifted(const Eigen::VectorXcd& amplitudes, const Eigen::Vector2d& origin) const {
  Eigen::VectorXcd shifted(amplitudes.size());
  for (std::size_t m = 0; m < waves_.size(); ++m)
    shifted[m] = amplitudes[m] * std::polar(1.0, waves_[m].wavenumber.dot(origin));
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

namespace {

// The limits of the cross-fade, in wavelengths along the side of the patch: waves below the first are plane waves
// only, waves above the second are in the patch only. Between them, the patch's lattice of wavenumbers begins to
// sample the spectrum as well as the rings and sectors of the plane waves do.
constexpr double kAllLong = 3, kAllPatch = 6;
// Approximate number of nodes along the shortest plane wave. In the middle of the cross-fade there are 20 nodes along a
// wave, where cubic interpolation has a relative error of 3/128 (2 pi / 20)^4 = 2e-4.
constexpr double kNodesPerLongWave = 14;

// The patch is at least as wide as the local surface, which extends one or two nodes beyond the reach on either side.
// This decides the patch for incidences above some 40 degrees.
constexpr double kPatchPerReach = 2.2;

CrossFade PatchShare(double patch_length) {
  const double dk = 2 * std::numbers::pi / patch_length;
  return CrossFade(kAllLong * dk, kAllPatch * dk);
}

// The distance from the axis within which the rays of a beam intersect the water, m: half the footprint, plus the
// horizontal shift of rays that meet the water up to six standard deviations above or below the point on the axis.
// The height difference over the distance r has the variance 2 sum P (1 - cos(k . r)) over waves of power P (the
// structure function); each term is approximated by P times the lesser of (k r)^2 and 2.
double Reach(const SeaState& sea, const BeamOptions& widest) {
  const double half_width = 0.5 * WidthOnWater(widest);
  const auto structure = [&](double k, double) {
    const double across = k * half_width;
    return std::min(1.0, 2 / (across * across));
  };
  const double tilt = 6 * std::sqrt(SlopeCovariance(sea, structure).trace());
  return half_width * (1 + tilt * std::tan(widest.incidence));
}

WavePatchModel MakePatch(const SeaState& sea, const BeamOptions& widest, const Discretization& discretization) {
  const double length =
      std::max(discretization.patch_per_beam * WidthOnWater(widest), kPatchPerReach * Reach(sea, widest));
  const int size = FastSize(length / widest.footprint * discretization.points_per_footprint);
  return WavePatchModel(sea, length, size, PatchShare(length));
}

Eigen::MatrixXcd Phases(const LongWaveModel& long_waves, int half_nodes, double node_spacing, int axis) {
  const int nodes = 2 * half_nodes + 1;
  Eigen::MatrixXcd phases(nodes, static_cast<Eigen::Index>(long_waves.waves().size()));
  for (int n = 0; n < nodes; ++n)
    for (Eigen::Index m = 0; m < phases.cols(); ++m)
      phases(n, m) = std::polar(1.0, long_waves.waves()[m].wavenumber[axis] * (n - half_nodes) * node_spacing);
  return phases;
}

// The weights of Lagrange's cubic through four equidistant nodes at -1, 0, 1, 2.
std::array<double, 4> CubicWeights(double t) {
  return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
          (t + 1) * t * (t - 1) / 6};
}

// The matrix of cubic Lagrange interpolation from 2 half_nodes + 1 nodes to points, `stride` points from one node to
// the next. The outermost intervals hold no points.
Eigen::MatrixXd CubicRefinement(int half_nodes, int stride) {
  const int intervals = 2 * (half_nodes - 1);
  Eigen::MatrixXd refinement = Eigen::MatrixXd::Zero(intervals * stride + 1, 2 * half_nodes + 1);
  for (int i = 0; i < refinement.rows(); ++i) {
    const int node = std::min(i / stride, intervals - 1);
    const std::array<double, 4> weights = CubicWeights(static_cast<double>(i - node * stride) / stride);
    for (int n = 0; n < 4; ++n) refinement(i, node + n) = weights[n];
  }
  return refinement;
}

// refinement * at_nodes, without the elements of CubicRefinement that are zero: all but four of a row.
Eigen::MatrixXd Refined(const Eigen::MatrixXd& refinement, const Eigen::MatrixXd& at_nodes) {
  const Eigen::Index intervals = refinement.cols() - 3, stride = (refinement.rows() - 1) / intervals;
  Eigen::MatrixXd refined(refinement.rows(), at_nodes.cols());
  for (Eigen::Index i = 0; i < refined.rows(); ++i) {
    const Eigen::Index node = std::min(i / stride, intervals - 1);
    const Eigen::Matrix<double, 1, 4> weights = refinement.row(i).segment<4>(node);
    for (Eigen::Index c = 0; c < refined.cols(); ++c) {
      const double* const n = &at_nodes(node, c);
      refined(i, c) = weights[0] * n[0] + weights[1] * n[1] + weights[2] * n[2] + weights[3] * n[3];
    }
  }
  return refined;
}

}  // namespace

SurfaceModel::SurfaceModel(const SeaState& sea, const BeamOptions& widest, const Discretization& discretization)
    : patch_(MakePatch(sea, widest, discretization)), long_waves_(sea, PatchShare(patch_.length())) {
  const int stride = std::max(1, static_cast<int>(std::lround(patch_.size() / (kAllPatch * kNodesPerLongWave))));
  const double node_spacing = stride * patch_.spacing();
  // The cubic needs one node beyond the reach.
  const int half_nodes = static_cast<int>(std::ceil(Reach(sea, widest) / node_spacing)) + 1;
  refine_ = CubicRefinement(half_nodes, stride);
  phase_x_ = Phases(long_waves_, half_nodes, node_spacing, 0);
  phase_y_ = Phases(long_waves_, half_nodes, node_spacing, 1);
}

Eigen::Matrix2d SurfaceModel::FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const {
  return patch_.FacetSlopeCovariance(weight) + long_waves_.SlopeCovariance(weight);
}

HeightField SurfaceModel::StillSurface() const {
  const int points = local_points();
  return HeightField(std::vector<double>(static_cast<std::size_t>(points) * points, 0.0), points, patch_.spacing());
}

SeaSurface::SeaSurface(const SurfaceModel& model, NormalStream stream)
    : model_(model), long_amplitudes_(model.long_waves_.Draw(stream)), patch_(model.patch_.Draw(stream)) {}

SeaSurface::LocalSurface SeaSurface::SurfaceUnder(const Beam& beam) const {
  const Eigen::Vector2d per_height = beam.per_height();
  const double elevation =
      HeightOfIntersection(model_.long_waves_, long_amplitudes_, Eigen::Vector2d::Zero(), per_height);
  const Eigen::VectorXcd amplitudes = model_.long_waves_.Shifted(long_amplitudes_, elevation * per_height);

  Eigen::MatrixXd at_nodes = SumOfWaves(model_.phase_x_, amplitudes, model_.phase_y_);
  at_nodes.array() -= elevation;

  const Eigen::MatrixXd long_waves = Refined(model_.refine_, Refined(model_.refine_, at_nodes).transpose()).transpose();
  const int points = static_cast<int>(long_waves.rows());
  const int size = model_.patch_.size();
  const int first = ((-(points - 1) / 2) % size + size) % size;  // the patch repeats
  std::vector<double> heights(static_cast<std::size_t>(points) * points);
  for (int i = 0; i < points; ++i) {
    const double* patch_row = &patch_[static_cast<std::size_t>((first + i) % size) * size];
    for (int j = 0; j < points; ++j)
      heights[static_cast<std::size_t>(i) * points + j] = long_waves(i, j) + patch_row[(first + j) % size];
  }
  return {HeightField(std::move(heights), points, model_.patch_.spacing()), elevation};
}

}  // namespace albtpu
