#include "generator/surface/sea_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "generator/math/fast_size.h"

namespace albtpu {
namespace {

// Waves that fit into the side of the patch this often are all plane waves, and all patch. In between,
// sampling the spectrum on the patch's lattice of wavenumbers becomes as good as the rings and sectors of the
// plane waves.
constexpr double kAllLong = 3, kAllPatch = 6;
// Nodes along the shortest plane wave, about. Cubic interpolation of heights is then right to 2e-4 amid the
// cross-fade.
constexpr double kNodesPerLongWave = 14;

// The patch is no narrower than the window, which goes a node or two beyond the reach on either side. Beams
// steeper than some 40 degrees want that.
constexpr double kPatchPerReach = 2.2;

CrossFade PatchShare(double patch_length) {
  const double dk = 2 * std::numbers::pi / patch_length;
  return CrossFade(kAllLong * dk, kAllPatch * dk);
}

// How far from its axis the rays of a beam meet the water, m: half the footprint, and the shift of rays that
// meet waves as much as six standard deviations above or below the point on the axis.
double Reach(const SeaState& sea, const BeamOptions& widest) {
  const double half_width = 0.5 * WidthOnWater(widest);
  const double tilt = 6 * std::sqrt(SlopeCovariance(sea, [&](double k, double) {
                                      const double across =
                                          k * half_width;  // structure function, 2 (1 - cos)
                                      return std::min(1.0, 2 / (across * across));
                                    }).trace());
  return half_width * (1 + tilt * std::tan(widest.incidence));
}

WavePatchModel MakePatch(const SeaState& sea, const BeamOptions& widest,
                         const Discretization& discretization) {
  const double length =
      std::max(discretization.patch_per_beam * WidthOnWater(widest), kPatchPerReach * Reach(sea, widest));
  const int size = FastSize(length / widest.footprint * discretization.points_per_footprint);
  return WavePatchModel(sea, length, size, PatchShare(length));
}

Eigen::MatrixXcd Phases(const LongWaveModel& long_waves, int half_nodes, double node_spacing, int axis) {
  const int nodes = 2 * half_nodes + 1;
  Eigen::MatrixXcd phases(nodes, static_cast<Eigen::Index>(long_waves.waves().size()));
  for (int n = 0; n < nodes; ++n) {
    for (Eigen::Index m = 0; m < phases.cols(); ++m) {
      phases(n, m) =
          std::polar(1.0, long_waves.waves()[m].wavenumber[axis] * (n - half_nodes) * node_spacing);
    }
  }
  return phases;
}

// Lagrange's cubic through four equidistant nodes at -1, 0, 1, 2.
std::array<double, 4> CubicWeights(double t) {
  return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
          (t + 1) * t * (t - 1) / 6};
}

// The matrix that takes values at 2 half_nodes + 1 nodes to the points between them, `stride` from node to node,
// without the outermost intervals, by cubic Lagrange interpolation.
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

}  // namespace

SurfaceModel::SurfaceModel(const SeaState& sea, const BeamOptions& widest,
                           const Discretization& discretization)
    : patch_(MakePatch(sea, widest, discretization)), long_waves_(sea, PatchShare(patch_.length())) {
  const int stride =
      std::max(1, static_cast<int>(std::lround(patch_.size() / (kAllPatch * kNodesPerLongWave))));
  const double node_spacing = stride * patch_.spacing();
  const int half_nodes =
      static_cast<int>(std::ceil(Reach(sea, widest) / node_spacing)) + 1;  // one for the cubic
  refine_ = CubicRefinement(half_nodes, stride);
  phase_x_ = Phases(long_waves_, half_nodes, node_spacing, 0);
  phase_y_ = Phases(long_waves_, half_nodes, node_spacing, 1);
}

Eigen::Matrix2d SurfaceModel::FacetSlopeCovariance(
    const std::function<double(double k, double psi)>& weight) const {
  return patch_.FacetSlopeCovariance(weight) + long_waves_.SlopeCovariance(weight);
}

HeightField SurfaceModel::StillSurface() const {
  const int points = local_points();
  return HeightField(std::vector<double>(static_cast<std::size_t>(points) * points, 0.0), points,
                     patch_.spacing());
}

SeaSurface::SeaSurface(const SurfaceModel& model, NormalStream stream)
    : model_(model), long_amplitudes_(model.long_waves_.Draw(stream)), patch_(model.patch_.Draw(stream)) {}

SeaSurface::LocalSurface SeaSurface::SurfaceUnder(const Beam& beam) const {
  const Eigen::Vector2d per_height = beam.per_height();
  const double elevation =
      HeightOfIntersection(model_.long_waves_, long_amplitudes_, Eigen::Vector2d::Zero(), per_height);
  const Eigen::VectorXcd amplitudes = model_.long_waves_.Shifted(long_amplitudes_, elevation * per_height);

  // The real part of phase_x diag(A) phase_y^T, as two products of real matrices.
  const Eigen::MatrixXcd weighted = model_.phase_x_ * amplitudes.asDiagonal();
  Eigen::MatrixXd at_nodes = weighted.real() * model_.phase_y_.real().transpose() -
                             weighted.imag() * model_.phase_y_.imag().transpose();
  at_nodes.array() -= elevation;

  const Eigen::MatrixXd long_waves = model_.refine_ * at_nodes * model_.refine_.transpose();
  const int points = static_cast<int>(long_waves.rows());
  const int size = model_.patch_.size();
  const int first = ((-(points - 1) / 2) % size + size) % size;  // the patch repeats
  std::vector<double> heights(static_cast<std::size_t>(points) * points);
  for (int i = 0; i < points; ++i) {
    const double* patch_row = &patch_[static_cast<std::size_t>((first + i) % size) * size];
    for (int j = 0; j < points; ++j) {
      heights[static_cast<std::size_t>(i) * points + j] = long_waves(i, j) + patch_row[(first + j) % size];
    }
  }
  return {HeightField(std::move(heights), points, model_.patch_.spacing()), elevation};
}

}  // namespace albtpu
