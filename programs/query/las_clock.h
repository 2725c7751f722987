// The times of the points of a LAS file in words, with the clocks that they may have.
#pragma once

#include <string>

#include "formats/clocks/trajectory_time.h"

namespace albtpu::programs {

// "2022-03-08T01:46:40Z to ..., by adjusted standard GPS time according to the header". Where the header's clock gives
// times that no point can have (before 1990, after the creation of the file or `now`, beyond a week), those clocks that
// give possible ones, with the flag that names each. `now`: GPS time, s since 1980.
std::string ClockText(const formats::PointTimes& points, double now);

// The clock in words that can be compared between files: the header's, or the only possible one.
std::string ClockName(const formats::PointTimes& points, double now);

}  // namespace albtpu::programs
