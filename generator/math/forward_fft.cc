#include "generator/math/forward_fft.h"

#include <fftw3.h>

#include <cassert>

#include "generator/math/fftw_planner.h"

namespace albtpu {

Eigen::MatrixXcd ForwardFft(const Eigen::MatrixXd& weights) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowMajorComplex =
      Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int size = static_cast<int>(weights.rows());
  assert(weights.cols() == size && size % 2 == 0);
  RowMajor in = weights;
  RowMajorComplex out(size, size / 2 + 1);
  fftw_plan plan;
  {
    const std::lock_guard lock(FftwPlanner());
    // FFTW_ESTIMATE picks the same plan each time; it leaves the arrays as they are.
    plan = fftw_plan_dft_r2c_2d(size, size, in.data(), reinterpret_cast<fftw_complex*>(out.data()),
                                FFTW_ESTIMATE);
  }
  fftw_execute(plan);
  {
    const std::lock_guard lock(FftwPlanner());
    fftw_destroy_plan(plan);
  }
  return out.conjugate();  // FFTW's forward transform has the other sign
}

}  // namespace albtpu
