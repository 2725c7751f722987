// How many points of a LAS file are of which class.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "absl/strings/str_cat.h"
#include "survey/las/las_point.h"

namespace albtpu::client {

class LasClassCounts {
 public:
  void Add(int point_class) { ++counts_[point_class]; }
  void Merge(const LasClassCounts& other) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  }

  std::uint64_t points() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

  // "class 1: 12345 points, class 26: 4321 points": what --classes can be given.
  std::string Text() const {
    std::string text;
    for (int i = 0; i < kClassCount; ++i) {
      if (counts_[i] == 0) continue;
      absl::StrAppend(&text, text.empty() ? "" : ", ", "class ", i, ": ", counts_[i], " points");
    }
    return text;
  }

  // {"1": 12345, "26": 4321}
  nlohmann::ordered_json Json() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (int i = 0; i < kClassCount; ++i) {
      if (counts_[i] > 0) json[std::to_string(i)] = counts_[i];
    }
    return json;
  }

 private:
  std::array<std::uint64_t, kClassCount> counts_ = {};
};

}  // namespace albtpu::client
