#include "generator/monte_carlo/surface_correlation.h"

#include <cassert>
#include <cmath>
#include <complex>

namespace albtpu {
namespace {

// Adds the periodic `correlations` of the patch at the lags of `sum`.
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

}  // namespace

SurfaceCorrelation::SurfaceCorrelation(const SurfaceModel& model, int reach) : reach_(reach) {
  assert(2 * reach < model.patch().size());
  const double spacing = model.patch().spacing();
  const std::vector<LongWaveModel::Wave>& waves = model.long_waves().waves();
  Eigen::ArrayX2d phase(waves.size(), 2);  // across one cell
  for (std::size_t m = 0; m < waves.size(); ++m) {
    phase.row(m) = (spacing * waves[m].wavenumber).transpose().array();
  }
  const Eigen::MatrixXcd x = Phases(phase.col(0), reach), y = Phases(phase.col(1), reach);
  const auto correlate = [&](const auto& factor) {
    Eigen::VectorXcd power(waves.size());
    for (std::size_t m = 0; m < waves.size(); ++m) {
      power[m] = waves[m].variance * factor(phase(m, 0), phase(m, 1));
    }
    Eigen::MatrixXd sum = SumOfWaves(x, power, y);
    AddPatch(model.patch().Correlate(factor), model.patch().size(), sum);
    return sum;
  };
  // The slope of a side for a wave of amplitude 1 is i times this quotient, a little less than the wavenumber.
  const auto quotient = [&](double phase_along) { return std::sin(phase_along / 2) * (2 / spacing); };
  using Complex = std::complex<double>;
  xx_ = correlate([&](double px, double) { return Complex(std::pow(quotient(px), 2)); });
  yy_ = correlate([&](double, double py) { return Complex(std::pow(quotient(py), 2)); });
  // At lags that are half a cell greater on both axes.
  xy_ = correlate(
      [&](double px, double py) { return quotient(px) * quotient(py) * std::polar(1.0, (px + py) / 2); });

  at_points_.height = correlate([](double, double) { return Complex(1); });
  at_points_.height.array() -= at_points_.height(reach, reach);
  at_points_.height_x = correlate([&](double px, double) { return Complex(0, quotient(px)); });
  at_points_.height_y = correlate([&](double, double py) { return Complex(0, quotient(py)); });
  at_points_.slope_xx = xx_;
  at_points_.slope_xy = correlate([&](double px, double py) { return Complex(quotient(px) * quotient(py)); });
  at_points_.slope_yy = yy_;
}

}  // namespace albtpu
