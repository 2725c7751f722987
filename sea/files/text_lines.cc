#include "sea/files/text_lines.h"

#include <charconv>
#include <cmath>
#include <string>

#include "sea/sea_time.h"

namespace albtpu {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::optional<std::string_view> TextLines::Next() {
  if (rest_.empty()) return std::nullopt;
  ++number_;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  if (end == std::string_view::npos) {
    rest_ = {};
    cut_ = !IsWhole(line);
    return cut_ ? std::nullopt : std::optional(line);
  }
  rest_.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  before_ = line;
  return line;
}

bool TextLines::IsWhole(std::string_view last) const {
  if (last_line_ == LastLine::kIsCut || last.empty() || last.size() > before_.size()) return false;
  const auto is_blank = [&](std::size_t i) { return kBlanks.find(before_[i]) != kBlanks.npos; };
  return !is_blank(last.size() - 1) && (last.size() == before_.size() || is_blank(last.size()));
}

absl::Status TextLines::CutError() const {
  return absl::InvalidArgumentError(cut_ ? absl::StrCat("its last line, ", number_,
                                                        ", has no end (the file was cut); get another copy "
                                                        "of the file, or end the line if it is whole")
                                         : absl::StrCat("it ends within a record, after line ", number_,
                                                        " (the file was cut); get another copy of the file"));
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::optional<double> ParseNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || !(IsDigit(word.back()) || word.back() == '.')) return std::nullopt;  // no inf, no nan
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range)
    return word.find_first_of("eE") != word.npos && word.find("-") != word.npos ? std::optional(0.0) : std::nullopt;
  if (error != std::errc()) return std::nullopt;
  const std::string_view rest(end, word.data() + word.size() - end);
  if (rest.empty()) return std::isfinite(value) ? std::optional(value) : std::nullopt;
  int exponent = 0;
  const char* const digits = rest.data() + (rest.front() == '+' ? 1 : 0);
  if (rest.size() != 4 || (rest.front() != '-' && rest.front() != '+')) return std::nullopt;
  if (std::from_chars(digits, rest.data() + 4, exponent).ptr != rest.data() + 4) return std::nullopt;
  value *= std::pow(10.0, exponent);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<int> ParseCount(std::string_view word) {
  int value = 0;
  if (word.empty() || !IsDigit(word.front())) return std::nullopt;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<double> SecondsOfDigits(std::string_view date, std::string_view time_of_day) {
  if (date.size() != 8 || time_of_day.size() != 6) return std::nullopt;
  const auto day = ParseCount(date), second = ParseCount(time_of_day);
  if (!day || !second) return std::nullopt;
  return SecondsOf({.year = *day / 10000,
                    .month = *day / 100 % 100,
                    .day = *day % 100,
                    .hour = *second / 10000,
                    .minute = *second / 100 % 100,
                    .second = *second % 100});
}

std::string Quoted(std::string_view word) {
  std::string quoted = "'";
  for (const char c : word.substr(0, 24)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (word.size() > 24 ? "...'" : "'");
}

std::optional<std::string_view> WordStream::NextLine() {
  words_.clear();
  taken_ = 0;
  while (const auto line = lines_.Next())
    if (!Words(*line).empty()) return line;
  return std::nullopt;
}

absl::StatusOr<std::vector<double>> WordStream::Numbers(std::size_t count, std::string_view what) {
  std::vector<double> numbers;
  while (numbers.size() < count) {
    if (taken_ == words_.size()) {
      const auto line = lines_.Next();
      if (!line) return lines_.CutError();
      words_ = Words(*line);
      taken_ = 0;
      continue;
    }
    const std::string_view word = words_[taken_++];
    const auto number = ParseNumber(word);
    if (!number) return lines_.Error(Quoted(word), " is not ", std::string(what), "; get another copy of the file");
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace albtpu
