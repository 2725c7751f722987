#include "quality/report/line_path.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace albtpu::quality {
namespace {

constexpr double kLatestPathTime = 1e12;  // s; larger ones are none.
constexpr std::int64_t kPathPause = 20;   // s, as that between lines without numbers (flight_lines.h).

}  // namespace

void LinePath::Add(const AnnotatedPoint& point) {
  if (!(std::abs(point.time) < kLatestPathTime)) return;
  const auto second = static_cast<std::int64_t>(std::floor(point.time));
  if (last_ == nullptr || second != last_second_) last_ = &seconds_[last_second_ = second];
  const auto count = static_cast<double>(++last_->points);
  last_->x += (point.x - last_->x) / count;
  last_->y += (point.y - last_->y) / count;
}

nlohmann::ordered_json LinePath::Json() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const std::size_t step = (seconds_.size() + kMostPlaces - 1) / kMostPlaces;
  std::optional<std::int64_t> before;
  std::size_t i = 0;
  for (const auto& [second, place] : seconds_) {
    const bool pause = before.has_value() && second - *before > kPathPause;
    if (pause) list.push_back(nullptr);
    if (i % step == 0 || i + 1 == seconds_.size() || pause) list.push_back({place.x, place.y});
    before = second;
    ++i;
  }
  return list;
}

}  // namespace albtpu::quality
