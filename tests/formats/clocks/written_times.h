// One half hour by every clock that files of points are written with.
#pragma once

#include "formats/clocks/point_clock.h"
#include "sea/sea_time.h"

namespace albtpu::formats {

inline double Utc(const char* text) { return ParseSeaTime(text).value(); }

inline TimeSpan Span(const char* first, const char* last) { return {Utc(first), Utc(last)}; }

// Wednesday 2016-05-11 from 14:00:00 UTC. GPS is 17 s ahead of UTC.
inline constexpr double kUnix = 1462975200;  // s since 1970, of the calendar
inline constexpr double kGpsTime = kUnix - 315964800 + 17;
inline constexpr double kOfWeek = kGpsTime - 1896 * kSecondsPerWeek;
inline constexpr double kOfDay = 14 * 3600 + 17;

// The half hour in a file.
struct Written {
  TimeFormat format;
  PointTimeForm header;  // What the file states, wrongly unless the format is kAuto.
  double first, unit;
  const char* description;
};

}  // namespace albtpu::formats
