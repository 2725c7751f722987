// Statistics of many annotated points: THU and TVU, the contributions to the variance, and how many meet each class of
// each specification.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "annotate/totals/total_summary.h"
#include "quality/annotated/annotated_points.h"
#include "quality/report/specification.h"

namespace albtpu::quality {

// Which classes a point meets.
class ClassJudge {
 public:
  static constexpr std::size_t kMaxClasses = 64;

  // `specifications` must outlive it and have at most kMaxClasses classes in all.
  explicit ClassJudge(const std::vector<Specification>& specifications);

  // Bit c: the point meets class c, counted over all specifications in their order. A class is met where the
  // uncertainty at its coverage plus the magnitude of the bias is within each of its limits: U = k sigma + |b|, JCGM
  // 100:2008, F.2.4.5. None without a number.
  std::uint64_t Met(const AnnotatedPoint& point) const;

 private:
  std::vector<SpecificationClass> classes_;
};

// The contributions to the vertical variance of points.
enum class VerticalShare : std::uint8_t { kAir, kSea, kWater, kDatum };
inline constexpr std::array<const char*, 4> kVerticalShareNames = {"air", "sea", "water", "datum"};

// m^2 at 1 sigma, by VerticalShare; the datum is the rest of the total. `point` has a number.
std::array<double, 4> VerticalShares(const AnnotatedPoint& point, Coverage coverage);

class PointTally {
 public:
  // `met` is ClassJudge::Met.
  void Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage);
  void Merge(const PointTally& other);

  std::uint64_t points() const { return points_; }
  std::uint64_t with_number() const { return thu_.count(); }
  std::uint64_t meeting(std::size_t of_class) const { return met_[of_class]; }

  // points, with_number; if there are any with a number thu, tvu (mean, median, p95, greatest), bias_vertical (mean),
  // shares_vertical and groups_vertical (fractions); meeting (of `classes` classes).
  nlohmann::ordered_json Json(std::size_t classes) const;

 private:
  std::uint64_t points_ = 0;
  annotate::LengthSpread thu_, tvu_;
  std::array<double, kVerticalShareNames.size()> shares_ = {};  // Sums, m^2.
  double pulse_ = 0, line_ = 0, bias_vertical_ = 0;             // Sums, m^2 and m.
  std::array<std::uint64_t, ClassJudge::kMaxClasses> met_ = {};
};

// Points of each metre of depth, the last without an end.
class DepthTallies {
 public:
  void Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage);  // With a number.

  // A list: from, to (null of the last), and PointTally::Json; bins without points are left out. Bins are as wide as
  // the ends in `ends` say, whole metres that rise; empty: a metre.
  nlohmann::ordered_json Json(std::size_t classes, const std::vector<int>& ends = {}) const;

 private:
  static constexpr int kBins = 100;
  std::vector<PointTally> bins_ = std::vector<PointTally>(kBins);
};

}  // namespace albtpu::quality
