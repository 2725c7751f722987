// Times of seas: seconds since 1970 in UTC, and instants of ISO 8601 as text, with seconds or not: 2020-06-08T03:50Z.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace albtpu {

// A date and a time of day, UTC.
struct CivilTime {
  int year, month, day, hour = 0, minute = 0, second = 0;
};

// s since 1970-01-01T00:00:00Z, without leap seconds; nullopt if there is no such date or time of day. Years 1900 to
// 2200.
std::optional<double> SecondsOf(const CivilTime& time);

// The same for a text; nullopt for other text.
std::optional<double> ParseSeaTime(std::string_view text);

// The inverse of ParseSeaTime(), rounded to whole seconds, which are left out if they are 0.
std::string SeaTimeText(double time);

}  // namespace albtpu
