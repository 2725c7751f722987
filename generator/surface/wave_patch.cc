#include "generator/surface/wave_patch.h"

#include <cassert>
#include <utility>

namespace albtpu {

WavePatchModel::WavePatchModel(const SeaState& sea, double length, int size, const CrossFade& share)
    : length_(length), size_(size), transform_(size) {
  assert(length > 0);
  const double dk = 2 * std::numbers::pi / length;
  const int half = size / 2;
  std::vector<double> phase(half), sine(half);  // of half a cell, by |i|
  for (int i = 0; i < half; ++i) {
    phase[i] = std::numbers::pi * i / size;
    sine[i] = std::sin(phase[i]);
  }
  power_.assign(static_cast<std::size_t>(size) * (half + 1), 0.0);
  for (int row = 0; row < size; ++row) {
    const int i = SignedIndex(row, size);
    if (i == half) continue;
    const double x = phase[std::abs(i)], sine_x = sine[std::abs(i)];
    for (int j = 0; j < half; ++j) {
      if (i == 0 && j == 0) continue;
      const double k = dk * std::hypot(i, j);
      const double held = share(k);
      if (held == 0) continue;
      // The mean square slope of the grid's triangles over that of the wave: from 1 to 4 / pi^2 for the shortest. A
      // triangle has the difference quotient of a wave, sin(kx dx / 2) / (dx / 2), and not its slope kx.
      const double y = phase[j];
      const double of_triangles = (sine_x * sine_x + sine[j] * sine[j]) / (x * x + y * y);
      power_[row * (half + 1) + j] = held * sea.Psi(k, std::atan2(j, i)) * dk * dk / of_triangles;
    }
  }
}

std::vector<double> WavePatchModel::Draw(const NormalStream& stream) const {
  const int half = size_ / 2 + 1;
  InverseFft::Modes amplitude = transform_.Allocate();
  std::vector<double> normals(2 * half);
  for (int row = 0; row < size_; ++row) {
    stream.Part(PartOfRow(SignedIndex(row, size_))).Fill(normals);
    for (int j = 0; j < half; ++j) {
      const std::size_t mode = static_cast<std::size_t>(row) * half + j;
      amplitude[mode] = std::sqrt(power_[mode] / 2) * std::complex<double>(normals[2 * j], normals[2 * j + 1]);
    }
  }
  // Both halves of the column j = 0 are stored: amplitude(-i, 0) must be the conjugate of amplitude(i, 0).
  for (int i = 1; i < size_ / 2; ++i) amplitude[(size_ - i) * half] = std::conj(amplitude[i * half]);
  return transform_(std::move(amplitude));
}

std::vector<double> WavePatchModel::Correlate(
    const std::function<std::complex<double>(double phase_x, double phase_y)>& factor) const {
  const int half = size_ / 2 + 1;
  const double turn = 2 * std::numbers::pi / size_;
  InverseFft::Modes product = transform_.Allocate();
  for (int row = 0; row < size_; ++row) {
    for (int j = 0; j < half; ++j) {
      const std::size_t mode = static_cast<std::size_t>(row) * half + j;
      product[mode] = power_[mode] == 0 ? 0 : power_[mode] * factor(turn * SignedIndex(row, size_), turn * j);
    }
  }
  return transform_(std::move(product));
}

double WavePatchModel::elevation_variance() const {
  double sum = 0;
  for (std::size_t m = 0; m < power_.size(); ++m) {
    const bool holds_both_halves = m % (size_ / 2 + 1) == 0;  // the column j = 0
    sum += power_[m] * (holds_both_halves ? 1 : 2);
  }
  return sum;
}

Eigen::Matrix2d WavePatchModel::FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const {
  const double dk = 2 * std::numbers::pi / length_;
  const double dx = spacing();
  std::vector<double> quotients(size_ / 2 + 1);  // by |i|; that of -i is its negative
  for (int i = 0; i <= size_ / 2; ++i) quotients[i] = 2 * std::sin(i * dk * dx / 2) / dx;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int row = 0; row < size_; ++row) {
    const int i = SignedIndex(row, size_);
    const double quotient_x = i < 0 ? -quotients[-i] : quotients[i];
    for (int j = 0; j < size_ / 2; ++j) {
      const double power = power_[row * (size_ / 2 + 1) + j];
      if (power == 0) continue;
      const double phase_x = i * dk * dx / 2, phase_y = j * dk * dx / 2;
      const Eigen::Vector2d quotient(quotient_x, quotients[j]);
      Eigen::Matrix2d squares = quotient * quotient.transpose();
      // The midpoints of a triangle's two sides are half a diagonal apart, in phase by phase_x + phase_y.
      squares(0, 1) *= std::cos(phase_x + phase_y);
      squares(1, 0) = squares(0, 1);
      covariance += power * (j == 0 ? 1 : 2) * weight(dk * std::hypot(i, j), std::atan2(j, i)) * squares;
    }
  }
  return covariance;
}

}  // namespace albtpu
