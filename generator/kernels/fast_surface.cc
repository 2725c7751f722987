#include "generator/kernels/fast_surface.h"

#include <algorithm>
#include <complex>

namespace albtpu {

FastSurface::FastSurface(const SurfaceModel& model)
    : long_waves_(model.long_waves()),
      patch_(model.patch(), model.local_points()),
      points_(model.local_points()),
      spacing_(static_cast<float>(model.patch().spacing())),
      phases_x_(model.phases_x().cast<std::complex<float>>()),
      cos_and_sin_y_(2 * model.phases_y().cols(), model.phases_y().rows()) {
  cos_and_sin_y_ << model.phases_y().real().transpose().cast<float>(),
      -model.phases_y().imag().transpose().cast<float>();
  const Eigen::MatrixXd& refinement = model.refinement();
  for (Eigen::Index i = 0; i < refinement.rows(); ++i) {
    int first = 0;
    while (refinement(i, first) == 0) ++first;
    first = std::min(first, static_cast<int>(refinement.cols()) - 4);
    Cubic cubic{first, {}};
    for (int n = 0; n < 4; ++n) cubic.weights[n] = static_cast<float>(refinement(i, first + n));
    cubics_.push_back(cubic);
  }
}

void FastSurface::Draw(NormalStream stream, Workspace& workspace) const {
  const Eigen::VectorXcd amplitudes = long_waves_.Draw(stream);
  double elevation = 0;
  workspace.long_slope.setZero();
  for (Eigen::Index m = 0; m < amplitudes.size(); ++m) {
    elevation += amplitudes[m].real();
    workspace.long_slope -= amplitudes[m].imag() * long_waves_.waves()[m].wavenumber;
  }

  // SumOfWaves at the nodes (columns along y), as one product in single precision without allocation:
  // [Re(phases_x diag(A)), Im(phases_x diag(A))] times [Re phases_y, -Im phases_y]^T.
  const Eigen::Index waves = amplitudes.size();
  Eigen::MatrixXf& of_row = workspace.long_waves_of_row;
  of_row.resize(phases_x_.rows(), 2 * waves);
  for (Eigen::Index m = 0; m < waves; ++m) {
    const std::complex<float> amplitude(amplitudes[m]);
    of_row.col(m) = (phases_x_.col(m) * amplitude).real();
    of_row.col(waves + m) = (phases_x_.col(m) * amplitude).imag();
  }
  Eigen::MatrixXf& at_nodes = workspace.long_waves_at_nodes;
  at_nodes.noalias() = of_row * cos_and_sin_y_;
  at_nodes.array() -= static_cast<float>(elevation);

  // Interpolate along y, then along x, and add the patch. Points along y are the rows: contiguous, as in `heights`.
  Eigen::MatrixXf& refined = workspace.refined;
  refined.resize(points_, at_nodes.rows());
  for (Eigen::Index node = 0; node < at_nodes.rows(); ++node) {
    for (int j = 0; j < points_; ++j) {
      const auto& [first, weights] = cubics_[j];
      float height = 0;
      for (int n = 0; n < 4; ++n) height += weights[n] * at_nodes(node, first + n);
      refined(j, node) = height;
    }
  }
  workspace.heights.resize(static_cast<std::size_t>(points_) * points_);
  patch_.Draw(stream, workspace.heights, workspace.patch);
  for (int i = 0; i < points_; ++i) {
    const auto& [first, weights] = cubics_[i];
    Eigen::Map<Eigen::ArrayXf>(&workspace.heights[static_cast<std::size_t>(i) * points_], points_) +=
        weights[0] * refined.col(first).array() + weights[1] * refined.col(first + 1).array() +
        weights[2] * refined.col(first + 2).array() + weights[3] * refined.col(first + 3).array();
  }
}

}  // namespace albtpu
