#include "formats/las/las_points.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "absl/strings/str_cat.h"

namespace albtpu::formats {

void LasClassCounts::Merge(const LasClassCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

std::uint64_t LasClassCounts::points() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

std::string LasClassCounts::Text() const {
  std::string text;
  for (int i = 0; i < kClassCount; ++i) {
    if (counts_[i] == 0) continue;
    absl::StrAppend(&text, text.empty() ? "" : ", ", "class ", i, ": ", counts_[i], " points");
  }
  return text;
}

nlohmann::ordered_json LasClassCounts::Json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (int i = 0; i < kClassCount; ++i) {
    if (counts_[i] > 0) json[std::to_string(i)] = counts_[i];
  }
  return json;
}

}  // namespace albtpu::formats
