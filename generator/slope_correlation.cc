#include "generator/slope_correlation.h"

#include <cassert>
#include <cmath>
#include <complex>

namespace albtpu {
namespace {

// The periodic `correlations` of the patch, at the lags of `sum`.
void AddPatch(const std::vector<double>& correlations, int size, Eigen::MatrixXd& sum) {
  const int reach = static_cast<int>(sum.rows() - 1) / 2;
  const auto wrapped = [&](int lag) { return (lag % size + size) % size; };
  for (int x = -reach; x <= reach; ++x) {
    const double* row = &correlations[static_cast<std::size_t>(wrapped(x)) * size];
    for (int y = -reach; y <= reach; ++y) sum(x + reach, y + reach) += row[wrapped(y)];
  }
}

// exp(i phase lag) for each wave (columns) at the lags from -reach to reach (rows).
Eigen::MatrixXcd Phases(const Eigen::ArrayXd& phase_per_lag, int reach) {
  Eigen::MatrixXcd phases(2 * reach + 1, phase_per_lag.size());
  for (Eigen::Index m = 0; m < phases.cols(); ++m) {
    const std::complex<double> turn = std::polar(1.0, phase_per_lag[m]);
    phases(reach, m) = 1;
    for (int lag = 1; lag <= reach; ++lag) {
      phases(reach + lag, m) = phases(reach + lag - 1, m) * turn;
      phases(reach - lag, m) = std::conj(phases(reach + lag, m));
    }
  }
  return phases;
}

// The real part of phases_x diag(power) phases_y^T.
Eigen::MatrixXd Sum(const Eigen::MatrixXcd& phases_x, const Eigen::VectorXcd& power,
                    const Eigen::MatrixXcd& phases_y) {
  const Eigen::MatrixXcd weighted = phases_x * power.asDiagonal();
  return weighted.real() * phases_y.real().transpose() - weighted.imag() * phases_y.imag().transpose();
}

}  // namespace

SlopeCorrelation::SlopeCorrelation(const SurfaceModel& model, int reach) : reach_(reach) {
  assert(2 * reach < model.patch().size());
  const double spacing = model.patch().spacing();
  const std::vector<LongWaveModel::Wave>& waves = model.long_waves().waves();
  Eigen::ArrayX2d half_phase(waves.size(), 2);  // along half a cell
  Eigen::ArrayXd variance(waves.size());
  for (std::size_t m = 0; m < waves.size(); ++m) {
    half_phase.row(m) = (0.5 * spacing * waves[m].wavenumber).transpose().array();
    variance[m] = waves[m].variance;
  }
  const Eigen::ArrayX2d quotient = half_phase.sin() * (2 / spacing);  // what a side makes of a wave's slope
  const Eigen::MatrixXcd x = Phases(2 * half_phase.col(0), reach), y = Phases(2 * half_phase.col(1), reach);
  const auto real = [](const Eigen::ArrayXd& power) { return Eigen::VectorXcd(power.matrix()); };
  xx_ = Sum(x, real(variance * quotient.col(0).square()), y);
  yy_ = Sum(x, real(variance * quotient.col(1).square()), y);
  Eigen::VectorXcd half_a_cell_away = real(variance * quotient.col(0) * quotient.col(1));
  for (Eigen::Index m = 0; m < half_a_cell_away.size(); ++m) {
    half_a_cell_away[m] *= std::polar(1.0, half_phase.row(m).sum());
  }
  xy_ = Sum(x, half_a_cell_away, y);

  const WavePatchModel::SlopeCorrelations patch = model.patch().CorrelateSlopes();
  AddPatch(patch.xx, model.patch().size(), xx_);
  AddPatch(patch.yy, model.patch().size(), yy_);
  AddPatch(patch.xy, model.patch().size(), xy_);
}

}  // namespace albtpu
