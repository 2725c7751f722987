// What a report states of each flight line. One point source ID may stand for several (crosscheck/flight_lines.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "quality/crosscheck/flight_lines.h"
#include "quality/report/line_path.h"
#include "quality/report/survey_grid.h"

namespace albtpu::quality {

class LineTallies {
 public:
  // `lines` knows the times of all points; `met` is ClassJudge::Met.
  void Add(const AnnotatedPoint& point, const FlightLines& lines, std::uint64_t met, Coverage coverage);

  // By ID and time: line (its ID), begin (where the ID has several lines), what PointTally has, path. Points without a
  // time of such an ID are a line without a begin.
  nlohmann::ordered_json Json(const FlightLines& lines, std::size_t classes) const;

 private:
  struct OfLine {
    PointTally tally;
    LinePath path;
  };
  static constexpr int kUnknown = -1;
  std::map<std::pair<int, int>, OfLine> lines_;  // By ID and number.
};

}  // namespace albtpu::quality
