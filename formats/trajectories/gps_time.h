// GPS time: seconds of a week, weeks, dates, and the leap seconds between it and UTC.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace albtpu::formats {

inline constexpr double kSecondsPerWeek = 604800;  // exact

// LAS files whose global encoding has bit 0 state GPS time minus this ("adjusted standard GPS time").
inline constexpr double kAdjustedGpsOffset = 1e9;  // s; ASPRS LAS 1.4 R15, table 4

// Whether `time`, which follows `before`, is in the next week because seconds of the week start again from 0 there: at
// most an hour passes between the two.
bool StartsNextWeek(double before, double time);

// GPS - UTC [s] at an instant given in seconds of UTC since 1980-01-06T00:00:00Z, not counting leap seconds.
int LeapSecondsAtUtc(double utc);

// An instant of ISO 8601 in UTC, `2016-05-11T14:00:00Z`, as GPS time: seconds since 1980-01-06T00:00:00Z, of which it
// is 17 s ahead in 2016. A blank may stand for T; seconds may be omitted or have a fraction. nullopt for other text,
// such as one without Z.
std::optional<double> ParseUtc(std::string_view text);

// The inverse, to whole seconds: `2016-05-11T14:00:00Z`. Requires 0 <= gps_time < 1e11 [s].
std::string UtcText(double gps_time);

}  // namespace albtpu::formats
