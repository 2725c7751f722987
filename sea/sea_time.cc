#include "sea/sea_time.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace albtpu {
namespace {

constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
constexpr std::size_t kWithoutSeconds = kForm.size() - 3;

bool HasForm(std::string_view text) {
  if (text.size() != kForm.size() && text.size() != kWithoutSeconds) return false;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kForm[i] == '0' ? !digit : text[i] != kForm[i]) return false;
  }
  return text.back() == 'Z';
}

}  // namespace

std::optional<double> SecondsOf(const CivilTime& time) {
  using namespace std::chrono;
  const auto is_within = [](int number, int least, int most) { return number >= least && number <= most; };
  // std::chrono keeps months and days in 8 bits: larger numbers are refused before.
  if (!is_within(time.year, 1900, 2200) || !is_within(time.month, 1, 12) || !is_within(time.day, 1, 31) ||
      !is_within(time.hour, 0, 23) || !is_within(time.minute, 0, 59) || !is_within(time.second, 0, 59))
    return std::nullopt;
  const year_month_day date(year{time.year}, month{static_cast<unsigned>(time.month)},
                            day{static_cast<unsigned>(time.day)});
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(sys_days(date).time_since_epoch().count()) + 3600.0 * time.hour +
         60.0 * time.minute + time.second;
}

std::optional<double> ParseSeaTime(std::string_view text) {
  if (!HasForm(text)) return std::nullopt;
  const auto part = [&](std::size_t from, std::size_t size) {
    int number = 0;
    for (const char digit : text.substr(from, size)) number = 10 * number + (digit - '0');
    return number;
  };
  return SecondsOf({.year = part(0, 4),
                    .month = part(5, 2),
                    .day = part(8, 2),
                    .hour = part(11, 2),
                    .minute = part(14, 2),
                    .second = text.size() == kForm.size() ? part(17, 2) : 0});
}

std::string SeaTimeText(double time) {
  using namespace std::chrono;
  const sys_seconds instant(seconds(std::llround(time)));
  const auto midnight = floor<days>(instant);
  const year_month_day date(midnight);
  const hh_mm_ss clock(instant - midnight);
  std::array<char, 32> text;
  int size = std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d", static_cast<int>(date.year()),
                           static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                           static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()));
  if (const int second = static_cast<int>(clock.seconds().count()); second != 0)
    size += std::snprintf(text.data() + size, text.size() - static_cast<std::size_t>(size), ":%02d", second);
  return std::string(text.data(), static_cast<std::size_t>(size)) + "Z";
}

}  // namespace albtpu
