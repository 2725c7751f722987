// What neighbouring pulses share of one state of the sea, in numbers for those who make surfaces of points.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "annotate/seas/sea_timeline.h"

namespace albtpu::annotate {

// For a footprint of 0.6 m at nadir and at 20 degrees, along the axis x of the sea: the share R of the variance of one
// pulse that the mean over a cell keeps, for cells of some sides, and the correlation of two pulses some metres and
// seconds apart, each of the slopes along and across the axis, of the horizontal and the vertical error and of the
// height of the water. Waves travel along the axis, in the sense of x.
nlohmann::ordered_json CorrelationJson(const SeaTimeline& seas, std::size_t record);

}  // namespace albtpu::annotate
