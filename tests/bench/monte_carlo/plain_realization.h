// One realization in straightforward C++: the standard library's random numbers, one FFTW transform of the whole patch
// in double precision, a walk from triangle to triangle, and sums over the rays for each depth.
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
  struct Intersection {
    double height, slope_x, slope_y;
  };
  Intersection Intersect(double x, double y, const Ray& ray) const;

  int size_;
  double spacing_;
  std::vector<double> scale_;  // of the modes' normal numbers; the signs put the patch's point 0 at the centre
  std::vector<std::complex<double>> modes_;
  std::vector<double> heights_;
  std::vector<Ray> rays_;
  std::unique_ptr<Plan> plan_;
};

}  // namespace albtpu::bench
