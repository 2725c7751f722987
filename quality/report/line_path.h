// Where a line was flown, for the plan of lines: the means of its points over a second each.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>

#include "quality/annotated/annotated_points.h"

namespace albtpu::quality {

class LinePath {
 public:
  void Add(const AnnotatedPoint& point);
  // [[x, y], ...] in the unit of the coordinates, by time, at most kMostPlaces; null between places that lie more than
  // 20 s apart: parts of a line, or several of one number.
  nlohmann::ordered_json Json() const;

 private:
  static constexpr std::size_t kMostPlaces = 100;
  struct Place {
    double x = 0, y = 0;
    std::uint64_t points = 0;
  };
  std::map<std::int64_t, Place> seconds_;
  std::int64_t last_second_ = 0;
  Place* last_ = nullptr;
};

}  // namespace albtpu::quality
