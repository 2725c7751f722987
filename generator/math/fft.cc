#include "generator/math/fft.h"

#include <fftw3.h>

#include <cassert>
#include <cmath>
#include <new>

namespace albtpu {
namespace {

// FFTW_ESTIMATE always chooses the same plan. A measured plan can change from run to run, and the last bit with it.
constexpr unsigned kPlanning = FFTW_ESTIMATE;

struct FreeReal {
  void operator()(double* memory) const { fftw_free(memory); }
};
using RealBuffer = std::unique_ptr<double[], FreeReal>;

template <typename T>
T* OrThrow(T* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

std::size_t Points(int size) { return static_cast<std::size_t>(size) * size; }

fftw_complex* AsFftw(const InverseFft::Modes& modes) { return reinterpret_cast<fftw_complex*>(modes.get()); }

}  // namespace

int FastSize(double at_least) {
  for (int size = 2 * static_cast<int>(std::ceil(at_least / 2));; size += 2) {
    int rest = size;
    for (const int factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return size;
  }
}

std::mutex& FftwPlanner() {
  static std::mutex mutex;
  return mutex;
}

struct InverseFft::Plan {
  Plan(int size, fftw_complex* modes, double* heights) {
    const std::lock_guard lock(FftwPlanner());
    plan = fftw_plan_dft_c2r_2d(size, size, modes, heights, kPlanning | FFTW_DESTROY_INPUT);
  }
  ~Plan() {
    const std::lock_guard lock(FftwPlanner());
    fftw_destroy_plan(plan);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  fftw_plan plan;
};

InverseFft::InverseFft(int size) : size_(size) {
  assert(size > 0 && size % 2 == 0);
  const Modes modes = Allocate();
  const RealBuffer heights(OrThrow(fftw_alloc_real(Points(size))));
  plan_ = std::make_unique<Plan>(size, AsFftw(modes), heights.get());
}

InverseFft::~InverseFft() = default;
InverseFft::InverseFft(InverseFft&&) noexcept = default;

void InverseFft::Free::operator()(std::complex<double>* memory) const { fftw_free(memory); }

InverseFft::Modes InverseFft::Allocate() const {
  const std::size_t count = static_cast<std::size_t>(size_) * (size_ / 2 + 1);
  return Modes(reinterpret_cast<std::complex<double>*>(OrThrow(fftw_alloc_complex(count))));
}

std::vector<double> InverseFft::operator()(Modes modes) const {
  const RealBuffer heights(OrThrow(fftw_alloc_real(Points(size_))));
  fftw_execute_dft_c2r(plan_->plan, AsFftw(modes), heights.get());
  return std::vector<double>(heights.get(), heights.get() + Points(size_));
}

Eigen::MatrixXcd ForwardFft(const Eigen::MatrixXd& weights) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowMajorComplex = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int size = static_cast<int>(weights.rows());
  assert(weights.cols() == size && size % 2 == 0);
  RowMajor in = weights;
  RowMajorComplex out(size, size / 2 + 1);
  fftw_plan plan;
  {
    const std::lock_guard lock(FftwPlanner());
    // Planning by estimate does not touch the arrays.
    plan = fftw_plan_dft_r2c_2d(size, size, in.data(), reinterpret_cast<fftw_complex*>(out.data()), kPlanning);
  }
  fftw_execute(plan);
  {
    const std::lock_guard lock(FftwPlanner());
    fftw_destroy_plan(plan);
  }
  return out.conjugate();  // FFTW's forward transform has the opposite sign in the exponent
}

}  // namespace albtpu
