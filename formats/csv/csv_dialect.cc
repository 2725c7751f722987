#include "formats/csv/csv_dialect.h"

#include <algorithm>
#include <array>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "formats/files/file_access.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr std::array<char, 3> kSeparators = {',', ';', '\t'};

const char* NameOfSeparator(char separator) {
  return separator == ',' ? "commas" : separator == ';' ? "semicolons" : "tabs";
}

bool IsDigit(char character) { return character >= '0' && character <= '9'; }

// Whether a cell is a number with exactly one `mark`: "4,5", "-,5", "1,5e3".
bool IsNumberWith(char mark, std::string_view cell) {
  while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\r')) cell.remove_suffix(1);
  std::size_t marks = 0, digits = 0;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const char character = cell[i];
    if (character == mark) {
      ++marks;
    } else if (IsDigit(character)) {
      ++digits;
    } else if (character == '+' || character == '-') {
      if (i > 0 && cell[i - 1] != 'e' && cell[i - 1] != 'E') return false;
    } else if ((character != 'e' && character != 'E') || digits == 0) {
      return false;
    }
  }
  return marks == 1 && digits > 0;
}

}  // namespace

std::string CsvDialect::Text() const {
  return absl::StrCat("columns separated by ", NameOfSeparator(separator), ", decimal ",
                      decimal == ',' ? "commas" : "points");
}

absl::StatusOr<char> SeparatorOf(std::string_view name, std::string_view header) {
  if (IsUtf16(header))
    return absl::InvalidArgumentError(absl::StrCat(std::string(name), " line 1: is UTF-16 text; save it as UTF-8"));
  std::array<std::size_t, kSeparators.size()> counts = {};
  bool quoted = false;
  char before = '\0';
  for (const char character : header) {
    if (character == '"') quoted = !quoted;
    const auto* const found = std::find(kSeparators.begin(), kSeparators.end(), character);
    const bool is_blank = character == '\t' && (before == ',' || before == ';');  // "depth,<tab>incidence"
    if (!quoted && !is_blank && found != kSeparators.end())
      ++counts[static_cast<std::size_t>(found - kSeparators.begin())];
    before = character;
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  const char separator = kSeparators[static_cast<std::size_t>(most - counts.begin())];
  if (*most == 0) return ',';
  const auto other = std::find(most + 1, counts.end(), *most);
  if (other == counts.end()) return separator;
  return absl::InvalidArgumentError(
      absl::StrCat(std::string(name), " line 1: has as many ", NameOfSeparator(separator), " as ",
                   NameOfSeparator(kSeparators[static_cast<std::size_t>(other - counts.begin())]),
                   ", so that either may separate its columns; put names that have one of them in quotes"));
}

absl::StatusOr<std::optional<char>> DecimalOf(std::string_view name, std::string_view text, std::size_t line,
                                              char separator) {
  std::optional<std::size_t> with_comma, with_point;  // Lines.
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size() && !(with_comma.has_value() && with_point.has_value()); ++i) {
    const bool ends = i == text.size() || text[i] == '\n' || text[i] == separator;
    if (i < text.size() && text[i] == '"') quoted = !quoted;
    if (!ends || (quoted && i < text.size())) {
      if (i < text.size() && text[i] == '\n') ++line;
      continue;
    }
    std::string_view cell = text.substr(begin, i - begin);
    while (!cell.empty() && cell.back() == '\r') cell.remove_suffix(1);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    if (!with_comma.has_value() && IsNumberWith(',', cell)) with_comma = line;
    if (!with_point.has_value() && IsNumberWith('.', cell)) with_point = line;
    begin = i + 1;
    if (i < text.size() && text[i] == '\n') ++line;
  }
  const bool both = with_comma.has_value() && with_point.has_value();
  if (both && separator == ',') return '.';  // A quoted cell such as "4,5" is a text then.
  if (both) {
    return absl::InvalidArgumentError(absl::StrCat(std::string(name), ": has a number with a comma in line ",
                                                   *with_comma, " and one with a point in line ", *with_point,
                                                   ", so that a comma may be a decimal mark or not; write one mark"));
  }
  if (with_comma.has_value()) return ',';
  if (with_point.has_value()) return '.';
  return std::nullopt;
}

std::string_view FirstRecordOf(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\n' && !quoted) return text.substr(0, i);
  }
  return text;
}

std::optional<std::string_view> WithPoint(std::string_view cell, const CsvDialect& dialect, std::string& buffer) {
  if (dialect.decimal == '.') return cell;
  if (cell.find('.') != cell.npos) return std::nullopt;
  if (cell.find(',') == cell.npos) return cell;
  buffer.assign(cell);
  std::replace(buffer.begin(), buffer.end(), ',', '.');
  return buffer;
}

void ToDialect(const CsvDialect& dialect, std::size_t begin, std::string& text) {
  if (dialect.decimal == '.') return;
  const std::size_t point = text.find('.', begin);
  if (point == text.npos) return;
  text[point] = ',';
  if (dialect.separator != ',') return;
  text.insert(begin, 1, '"');
  text += '"';
}

}  // namespace albtpu::formats
