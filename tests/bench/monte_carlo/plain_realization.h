// One realization as a good engineer writes it in an afternoon: the standard library's random numbers, one
// double FFTW transform of the whole patch, a walk from triangle to triangle, and sums over rays for each
// depth.
#pragma once

#include <complex>
#include <memory>
#include <random>
#include <vector>

#include "tests/bench/monte_carlo/beam_case.h"

namespace albtpu::bench {

class PlainRealization {
 public:
  explicit PlainRealization(const BeamCase& beam_case);
  ~PlainRealization();

  void DrawSurface(std::mt19937_64& random);
  void SetSurface(const std::vector<double>& heights);  // size x size, centre at (size / 2, size / 2)
  Spots Trace(double refractive_index) const;
  const std::vector<double>& heights() const { return heights_; }

 private:
  struct Plan;
  struct Meeting {
    double height, slope_x, slope_y;
  };
  Meeting Meet(double x, double y, const Ray& ray) const;

  int size_;
  double spacing_;
  std::vector<double> scale_;  // of the mode's normals; its sign puts patch point 0 at the centre
  std::vector<std::complex<double>> modes_;
  std::vector<double> heights_;
  std::vector<Ray> rays_;
  std::unique_ptr<Plan> plan_;
};

}  // namespace albtpu::bench
