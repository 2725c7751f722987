#include "sea/files/ndbc_header.h"

#include <array>

#include "sea/files/text_lines.h"
#include "sea/sea_time.h"

namespace albtpu {

NdbcDate NdbcDateColumns(std::span<const std::string_view> header) {
  if (header.size() < 4) return {};
  std::string_view year = header[0];
  if (year.starts_with('#')) year.remove_prefix(1);
  if ((year != "YY" && year != "YYYY") || header[1] != "MM" || header[2] != "DD" || header[3] != "hh")
    return {};
  return {.count = header.size() > 4 && header[4] == "mm" ? std::size_t{5} : std::size_t{4}};
}

std::optional<double> NdbcTime(std::span<const std::string_view> words, NdbcDate date) {
  if (words.size() < date.count) return std::nullopt;
  std::array<int, 5> parts{};
  for (std::size_t i = 0; i < date.count; ++i) {
    const auto part = ParseCount(words[i]);
    if (!part) return std::nullopt;
    parts[i] = *part;
  }
  const int year = words[0].size() == 2 ? 1900 + parts[0] : parts[0];
  return SecondsOf({.year = year, .month = parts[1], .day = parts[2], .hour = parts[3], .minute = parts[4]});
}

}  // namespace albtpu
