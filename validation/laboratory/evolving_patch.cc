#include "validation/laboratory/evolving_patch.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "validation/laboratory/dispersion.h"

namespace albtpu {

EvolvingPatch::EvolvingPatch(const SeaState& sea, double length, int size, const NormalStream& stream)
    : transform_(size) {
  assert(length > 0);
  const int half = size / 2 + 1;
  const double dk = 2 * std::numbers::pi / length;
  modes_.assign(static_cast<std::size_t>(size) * half, {0, 0, 0});
  std::vector<double> normals(4 * half);
  for (int row = 0; row < size; ++row) {
    const int i = SignedIndex(row, size);
    if (i == size / 2) continue;
    stream.Part(row).Fill(normals);
    for (int j = 0; j < size / 2; ++j) {
      if (i == 0 && j == 0) continue;
      const double k = dk * std::hypot(i, j);
      const double psi = std::atan2(j, i);
      // Half of an amplitude whose real and imaginary parts each have the variance Psi dkx dky.
      const double forward = 0.5 * dk * std::sqrt(sea.DirectionalPsi(k, psi));
      const double backward = 0.5 * dk * std::sqrt(sea.DirectionalPsi(k, psi + std::numbers::pi));
      const double* normal = &normals[4 * j];
      modes_[static_cast<std::size_t>(row) * half + j] = {
          AngularFrequency(k), forward * std::complex<double>(normal[0], normal[1]),
          backward * std::complex<double>(normal[2], normal[3])};
    }
  }
  // Both halves of the column j = 0 are stored: each mode is the mirror of the one at -i.
  for (int i = 1; i < size / 2; ++i) {
    const Mode& upper = modes_[static_cast<std::size_t>(i) * half];
    modes_[static_cast<std::size_t>(size - i) * half] = {upper.angular_frequency, std::conj(upper.backward),
                                                         std::conj(upper.forward)};
  }
}

std::vector<double> EvolvingPatch::HeightsAt(double time) const {
  InverseFft::Modes amplitudes = transform_.Allocate();
  for (std::size_t m = 0; m < modes_.size(); ++m) {
    const std::complex<double> turn = std::polar(1.0, -modes_[m].angular_frequency * time);
    amplitudes[m] = modes_[m].forward * turn + modes_[m].backward * std::conj(turn);
  }
  return transform_(std::move(amplitudes));
}

}  // namespace albtpu
