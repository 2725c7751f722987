#include "generator/wave_patch.h"

#include <fftw3.h>

#include <cassert>
#include <cmath>
#include <complex>
#include <mutex>
#include <new>
#include <numbers>

namespace albtpu {
namespace {

// The planner of FFTW is not thread-safe; executing a plan is.
std::mutex& PlannerMutex() {
  static std::mutex mutex;
  return mutex;
}

template <typename T>
struct FftwFree {
  void operator()(T* p) const { fftw_free(p); }
};
using RealBuffer = std::unique_ptr<double, FftwFree<double>>;
using ComplexBuffer = std::unique_ptr<fftw_complex, FftwFree<fftw_complex>>;

template <typename T>
T* OrThrow(T* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// Each row of modes has a part of the stream to itself, whatever the size of the grid; part 0 is the long waves'.
std::uint32_t PartOfRow(int i) { return i >= 0 ? 2 * i + 1 : -2 * i; }

int SignedIndex(int i, int size) { return i <= size / 2 ? i : i - size; }

}  // namespace

struct WavePatchModel::Plan {
  explicit Plan(int size) {
    const std::lock_guard lock(PlannerMutex());
    // FFTW_ESTIMATE picks the same plan each time; a measured plan can differ from run to run in the last
    // bit.
    const ComplexBuffer in(OrThrow(fftw_alloc_complex(static_cast<std::size_t>(size) * (size / 2 + 1))));
    const RealBuffer out(OrThrow(fftw_alloc_real(static_cast<std::size_t>(size) * size)));
    plan = fftw_plan_dft_c2r_2d(size, size, in.get(), out.get(), FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  }
  ~Plan() {
    const std::lock_guard lock(PlannerMutex());
    fftw_destroy_plan(plan);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  fftw_plan plan;
};

WavePatchModel::WavePatchModel(const SeaState& sea, double length, int size, const CrossFade& share)
    : length_(length), size_(size), plan_(std::make_unique<Plan>(size)) {
  assert(length > 0 && size > 0 && size % 2 == 0);
  const double dk = 2 * std::numbers::pi / length;
  power_.assign(static_cast<std::size_t>(size) * (size / 2 + 1), 0.0);
  for (int row = 0; row < size; ++row) {
    const int i = SignedIndex(row, size);
    if (i == size / 2) continue;
    for (int j = 0; j < size / 2; ++j) {
      if (i == 0 && j == 0) continue;
      const double k = dk * std::hypot(i, j);
      if (share(k) == 0) continue;
      power_[row * (size / 2 + 1) + j] = share(k) * sea.Psi(k, std::atan2(j, i)) * dk * dk;
    }
  }
}

WavePatchModel::~WavePatchModel() = default;
WavePatchModel::WavePatchModel(WavePatchModel&&) noexcept = default;

std::vector<double> WavePatchModel::Draw(const NormalStream& stream) const {
  const int half = size_ / 2 + 1;
  const ComplexBuffer amplitudes(OrThrow(fftw_alloc_complex(power_.size())));
  auto* amplitude = reinterpret_cast<std::complex<double>*>(amplitudes.get());
  std::vector<double> normals(2 * half);
  for (int row = 0; row < size_; ++row) {
    stream.Part(PartOfRow(SignedIndex(row, size_))).Fill(normals);
    for (int j = 0; j < half; ++j) {
      const std::size_t mode = static_cast<std::size_t>(row) * half + j;
      amplitude[mode] =
          std::sqrt(power_[mode] / 2) * std::complex<double>(normals[2 * j], normals[2 * j + 1]);
    }
  }
  // Both halves of the column j = 0 are stored: the lower one must be the mirror of the upper.
  for (int i = 1; i < size_ / 2; ++i) amplitude[(size_ - i) * half] = std::conj(amplitude[i * half]);

  const RealBuffer heights(OrThrow(fftw_alloc_real(static_cast<std::size_t>(size_) * size_)));
  fftw_execute_dft_c2r(plan_->plan, amplitudes.get(), heights.get());
  return std::vector<double>(heights.get(), heights.get() + static_cast<std::size_t>(size_) * size_);
}

double WavePatchModel::elevation_variance() const {
  double sum = 0;
  for (std::size_t m = 0; m < power_.size(); ++m) {
    const bool own_mirror_column = m % (size_ / 2 + 1) == 0;
    sum += power_[m] * (own_mirror_column ? 1 : 2);
  }
  return sum;
}

Eigen::Matrix2d WavePatchModel::FacetSlopeCovariance(
    const std::function<double(double k, double psi)>& weight) const {
  const double dk = 2 * std::numbers::pi / length_;
  const double dx = spacing();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int row = 0; row < size_; ++row) {
    for (int j = 0; j < size_ / 2; ++j) {
      const double power = power_[row * (size_ / 2 + 1) + j];
      if (power == 0) continue;
      const int i = SignedIndex(row, size_);
      const double phase_x = i * dk * dx / 2, phase_y = j * dk * dx / 2;
      const Eigen::Vector2d quotient(2 * std::sin(phase_x) / dx, 2 * std::sin(phase_y) / dx);
      Eigen::Matrix2d squares = quotient * quotient.transpose();
      squares(0, 1) *= std::cos(phase_x + phase_y);  // the two sides of a triangle are half a diagonal apart
      squares(1, 0) = squares(0, 1);
      covariance += power * (j == 0 ? 1 : 2) * weight(dk * std::hypot(i, j), std::atan2(j, i)) * squares;
    }
  }
  return covariance;
}

}  // namespace albtpu
