#include "tests/bench/monte_carlo/plain_realization.h"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>

#include "generator/math/fft.h"

namespace albtpu::bench {

struct PlainRealization::Plan {
  Plan(int size, std::complex<double>* modes, double* heights) {
    const std::lock_guard lock(FftwPlanner());
    plan = fftw_plan_dft_c2r_2d(size, size, reinterpret_cast<fftw_complex*>(modes), heights, FFTW_MEASURE);
  }
  ~Plan() {
    const std::lock_guard lock(FftwPlanner());
    fftw_destroy_plan(plan);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  fftw_plan plan;
};

PlainRealization::PlainRealization(const BeamCase& beam_case)
    : size_(beam_case.options().size),
      spacing_(beam_case.patch().spacing()),
      modes_(static_cast<std::size_t>(size_) * (size_ / 2 + 1)),
      heights_(static_cast<std::size_t>(size_) * size_),
      rays_(beam_case.rays()),
      plan_(std::make_unique<Plan>(size_, modes_.data(), heights_.data())) {
  for (int row = 0; row < size_; ++row) {
    for (int j = 0; j <= size_ / 2; ++j) {
      const int i = SignedIndex(row, size_);
      scale_.push_back(((row + j) % 2 == 0 ? 1 : -1) * std::sqrt(beam_case.ModePower(i, j) / 2));
    }
  }
}

PlainRealization::~PlainRealization() = default;

void PlainRealization::DrawSurface(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (std::size_t m = 0; m < modes_.size(); ++m) {
    const double re = normal(random), im = normal(random);
    modes_[m] = scale_[m] * std::complex<double>(re, im);
  }
  const int half = size_ / 2 + 1;
  for (int i = 1; i < size_ / 2; ++i) modes_[(size_ - i) * half] = std::conj(modes_[i * half]);
  fftw_execute(plan_->plan);
}

void PlainRealization::SetSurface(const std::vector<double>& heights) {
  assert(heights.size() == heights_.size());
  heights_ = heights;
}

PlainRealization::Intersection PlainRealization::Intersect(double x, double y, const Ray& ray) const {
  const double per_x = ray.direction.x() / ray.direction.z(), per_y = ray.direction.y() / ray.direction.z();
  const int centre = size_ / 2;
  Intersection hit{};
  int last_ix = -1, last_iy = -1;
  bool last_beside_x = false;
  for (int step = 0; step < 20; ++step) {
    const double at_x = (x + hit.height * per_x) / spacing_ + centre;
    const double at_y = (y + hit.height * per_y) / spacing_ + centre;
    const int ix = std::clamp(static_cast<int>(at_x), 0, size_ - 2);
    const int iy = std::clamp(static_cast<int>(at_y), 0, size_ - 2);
    const double u = at_x - ix, v = at_y - iy;
    const bool beside_x = u > v;
    if (ix == last_ix && iy == last_iy && beside_x == last_beside_x) break;
    const double* low = &heights_[static_cast<std::size_t>(ix) * size_ + iy];
    const double* high = low + size_;
    const double rise_x = beside_x ? high[0] - low[0] : high[1] - low[1];
    const double rise_y = beside_x ? high[1] - high[0] : low[1] - low[0];
    hit.slope_x = rise_x / spacing_;
    hit.slope_y = rise_y / spacing_;
    const double clearance = hit.height - (low[0] + u * rise_x + v * rise_y);
    hit.height -= clearance / (1 - hit.slope_x * per_x - hit.slope_y * per_y);
    last_ix = ix;
    last_iy = iy;
    last_beside_x = beside_x;
  }
  return hit;
}

Spots PlainRealization::Trace(double refractive_index) const {
  struct Refracted {
    double x, y, z;  // where it enters the water, m
    Eigen::Vector3d direction;
  };
  static thread_local std::vector<Refracted> below;
  below.clear();
  double mean_x = 0, mean_y = 0, mean_height = 0;
  for (const Ray& ray : rays_) {
    const Intersection hit = Intersect(ray.at_zero.x(), ray.at_zero.y(), ray);
    const Eigen::Vector3d normal = Eigen::Vector3d(-hit.slope_x, -hit.slope_y, 1).normalized();
    const double cosine = -normal.dot(ray.direction), ratio = 1 / refractive_index;
    const Eigen::Vector3d direction =
        ratio * ray.direction + (ratio * cosine - std::sqrt(1 - ratio * ratio * (1 - cosine * cosine))) * normal;
    const double x = ray.at_zero.x() + hit.height * ray.direction.x() / ray.direction.z();
    const double y = ray.at_zero.y() + hit.height * ray.direction.y() / ray.direction.z();
    below.push_back({x, y, hit.height, direction});
    mean_x += x;
    mean_y += y;
    mean_height += hit.height;
  }
  const double count = static_cast<double>(rays_.size());
  mean_x /= count;
  mean_y /= count;
  mean_height /= count;
  Spots spots{};
  for (std::size_t d = 0; d < spots.size(); ++d) {
    for (const Refracted& ray : below) {
      const double path = (mean_height - kDepths[d] - ray.z) / ray.direction.z();
      spots[d].x += ray.x + path * ray.direction.x();
      spots[d].y += ray.y + path * ray.direction.y();
      spots[d].path += path;
    }
    spots[d].x = spots[d].x / count - mean_x;
    spots[d].y = spots[d].y / count - mean_y;
    spots[d].path /= count;
  }
  return spots;
}

}  // namespace albtpu::bench
