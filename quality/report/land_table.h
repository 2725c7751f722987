// The dry points of a survey, which S-44 does not judge: their standard deviations, and the root mean square errors by
// which standards of topographic lidar count.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "annotate/totals/total_summary.h"
#include "quality/annotated/annotated_points.h"
#include "quality/report/specification.h"

namespace albtpu::quality {

// Root mean square errors of what points were or will be compared with, m.
struct CheckPointErrors {
  double horizontal = 0;  // Radial.
  double vertical = 0;
};

// The standard deviations of points, and the root mean square errors that follow: an RMSE is the root of the mean of
// squared errors, and the mean of the square of an error without bias is its variance, whatever its distribution is and
// however the errors of points are correlated. The horizontal RMSE is radial: the variance of the two axes together.
class RmseTally {
 public:
  void Add(const DryPoint& point);
  std::uint64_t points() const { return vertical_sigma_.count(); }
  double horizontal() const;  // m, of at least one point.
  double vertical() const;

  // points; if there are any, sigma_horizontal and sigma_vertical (median, p95, greatest), rmse_horizontal,
  // rmse_vertical and rmse_3d.
  nlohmann::ordered_json Json() const;

 private:
  annotate::LengthSpread horizontal_sigma_, vertical_sigma_;
  double horizontal_ = 0, vertical_ = 0;  // Sums of variances, m^2.
};

class LandTable {
 public:
  void Add(const DryPoint& point);
  bool empty() const { return all_.points() == 0; }

  // Null without a point of land. RmseTally::Json of all; `by_class`, the same of each class of LAS;
  // water_surface_points, which have a total of the air side, too, and are not of land; check_points; `against`: the
  // RMSE of differences from check points with these errors, and what is held against the classes, to which edition 2
  // of ASPRS adds the errors of check points once more; `classes` of the specifications that state RMSE.
  nlohmann::ordered_json Json(const std::vector<Specification>& specifications, const CheckPointErrors& errors) const;

 private:
  RmseTally all_;
  std::map<int, RmseTally> classes_;
  std::uint64_t water_surface_ = 0;
};

}  // namespace albtpu::quality
