#include "validation/laboratory/wave_staff.h"

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "validation/laboratory/dispersion.h"
#include "validation/laboratory/frequency_spectrum.h"

namespace albtpu {

WaveStaff::WaveStaff(const SeaState& sea, int samples, double rate)
    : samples_(samples), power_(2 * static_cast<std::size_t>(samples), 0.0) {
  assert(samples > 0 && rate > 0);
  const double df = rate / static_cast<double>(power_.size());
  const double highest = AngularFrequency(sea.energetic_range().highest) / (2 * std::numbers::pi);
  for (std::size_t m = 1; static_cast<double>(m) * df <= highest; ++m) {
    power_[m % power_.size()] += FrequencySpectrum(sea, static_cast<double>(m) * df) * df;
  }
}

std::vector<double> WaveStaff::Draw(NormalStream stream) const {
  std::vector<double> normals(2 * power_.size());
  stream.Fill(normals);
  std::vector<std::complex<double>> turning(power_.size());
  for (std::size_t m = 0; m < power_.size(); ++m) {
    turning[m] = std::sqrt(power_[m]) * std::complex<double>(normals[2 * m], normals[2 * m + 1]);
  }
  std::vector<std::complex<double>> elevation;
  Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(), Eigen::FFT<double>::Unscaled);
  fft.inv(elevation, turning);
  std::vector<double> record(samples_);
  for (int n = 0; n < samples_; ++n) record[n] = elevation[n].real();
  return record;
}

}  // namespace albtpu
