#include "generator/mean_slope.h"

#include <algorithm>

namespace albtpu {
namespace {

// The weights of the heights of the window in the mean slope of the facets over which `rays` cross z = 0.
std::array<Eigen::MatrixXd, 2> Weights(const SurfaceModel& model, const std::vector<Ray>& rays) {
  const int points = model.window_points();
  const HeightField still = model.StillWindow();
  const double weight = 1 / (still.spacing() * static_cast<double>(rays.size()));
  std::array<Eigen::MatrixXd, 2> weights = {Eigen::MatrixXd::Zero(points, points),
                                            Eigen::MatrixXd::Zero(points, points)};
  for (const Ray& ray : rays) {
    const auto [ix, iy, beside_x] = still.TriangleAt(ray.at_zero);
    const int along_x = beside_x ? iy : iy + 1, along_y = beside_x ? ix + 1 : ix;  // its sides, as in FacetOf
    weights[0](ix + 1, along_x) += weight;
    weights[0](ix, along_x) -= weight;
    weights[1](along_y, iy + 1) += weight;
    weights[1](along_y, iy) -= weight;
  }
  return weights;
}

}  // namespace

MeanSlope::MeanSlope(const SurfaceModel& model, const Beam& beam, const std::vector<Ray>& rays) {
  const std::array<Eigen::MatrixXd, 2> weights = Weights(model, rays);
  moments_ = model.MomentsOf(weights, beam.per_height());

  const int points = model.window_points();
  const auto reached = [&](int i) {
    return weights[0].row(i).any() || weights[1].row(i).any() || weights[0].col(i).any() ||
           weights[1].col(i).any();
  };
  first_ = 0;
  while (!reached(first_)) ++first_;
  int last = points - 1;
  while (!reached(last)) --last;
  count_ = last - first_ + 1;
  for (int f = 0; f < 2; ++f) weights_[f] = weights[f].block(first_, first_, count_, count_).transpose();
}

Eigen::Vector2d MeanSlope::operator()(const HeightField& window) const {
  const Eigen::Map<const Eigen::MatrixXd> heights(window.heights().data(), window.points(), window.points());
  const auto reached = heights.block(first_, first_, count_, count_);  // ix is slow: the column
  return {weights_[0].cwiseProduct(reached).sum(), weights_[1].cwiseProduct(reached).sum()};
}

}  // namespace albtpu
