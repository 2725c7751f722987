#include "generator/math/inverse_fft.h"

#include <fftw3.h>

#include <cassert>
#include <mutex>
#include <new>

#include "generator/math/fftw_planner.h"

namespace albtpu {
namespace {

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

struct InverseFft::Plan {
  Plan(int size, fftw_complex* modes, double* heights) {
    const std::lock_guard lock(FftwPlanner());
    // FFTW_ESTIMATE picks the same plan each time; a measured plan can differ from run to run in the last
    // bit.
    plan = fftw_plan_dft_c2r_2d(size, size, modes, heights, FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
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

}  // namespace albtpu
