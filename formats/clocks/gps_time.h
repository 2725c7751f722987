// GPS time: weeks, dates, and the leap seconds between it and UTC.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace albtpu::formats {

inline constexpr double kSecondsPerDay = 86400;    // Of UTC without its leap seconds; exact.
inline constexpr double kSecondsPerWeek = 604800;  // exact

// LAS files whose global encoding has bit 0 state GPS time minus this ("adjusted standard GPS time").
inline constexpr double kAdjustedGpsOffset = 1e9;  // s; ASPRS LAS 1.4 R15, table 4

inline constexpr double kGpsEpoch = 315964800;  // 1980-01-06T00:00:00Z in s since 1970; exact

// GPS - UTC [s] at an instant given in seconds of UTC since 1980-01-06T00:00:00Z, not counting leap seconds.
int LeapSecondsAtUtc(double utc);

// An instant of ISO 8601 in UTC, `2016-05-11T14:00:00Z`, as GPS time: seconds since 1980-01-06T00:00:00Z, of which it
// is 17 s ahead in 2016. A blank may stand for T; seconds may be omitted or have a fraction. nullopt for other text,
// such as one without Z.
std::optional<double> ParseUtc(std::string_view text);

// The inverse, to whole seconds: `2016-05-11T14:00:00Z`. Requires 0 <= gps_time < kLastText [s].
inline constexpr double kLastText = 1e11;
std::string UtcText(double gps_time);

// The same of any GPS time, and the date alone, `2016-05-11`; "a time before 1980", "a date before 1980".
std::string InstantText(double gps_time);
std::string DateText(double gps_time);

// UTC, s since 1970 without leap seconds, of a GPS time, s since 1980, and the inverse.
double UtcOfGps(double gps);
double GpsOfUtc(double utc);

// GPS - UTC [s] at a GPS time, s since 1980.
int GpsMinusUtc(double gps);

// The beginning of a day in UTC as GPS time, s since 1980, by the number of the day in its year, from 1. nullopt where
// there is no such day, or none of a laser survey: before 1990 or after 2100.
std::optional<double> GpsTimeOfDay(int year, int day_of_year);

// GPS - UTC since 1 January 2017, for times whose date is not known. IERS has announced no further leap second.
inline constexpr double kGpsMinusUtcNow = 18;  // s

}  // namespace albtpu::formats
