#include "generator/surface/sea_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "generator/math/fft.h"

namespace albtpu {
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

}  // namespace

SurfaceModel::SurfaceModel(const SeaState& sea, const BeamOptions& widest,
                           const Discretization& discretization)
    : patch_(MakePatch(sea, widest, discretization)), long_waves_(sea, PatchShare(patch_.length())) {
  const int stride =
      std::max(1, static_cast<int>(std::lround(patch_.size() / (kAllPatch * kNodesPerLongWave))));
  const double node_spacing = stride * patch_.spacing();
  // The cubic needs one node beyond the reach.
  const int half_nodes = static_cast<int>(std::ceil(Reach(sea, widest) / node_spacing)) + 1;
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

  Eigen::MatrixXd at_nodes = SumOfWaves(model_.phase_x_, amplitudes, model_.phase_y_);
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
