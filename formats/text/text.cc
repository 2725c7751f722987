#include "formats/text/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "absl/strings/cord.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/string_view.h"

namespace albtpu::formats {
namespace {

constexpr char kUsagePayload[] = "albtpu/usage";

constexpr std::size_t kMaxEdits = 3;
constexpr std::size_t kEditsPer = 2,
                      kCharactersPer = 5;  // the maximum number of edits per number of characters

}  // namespace

absl::Status UsageError(std::string_view message) {
  absl::Status status = absl::InvalidArgumentError(absl::string_view(message.data(), message.size()));
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

bool IsUsageError(const absl::Status& status) { return status.GetPayload(kUsagePayload).has_value(); }

absl::Status InvalidFile(const std::string& name, const std::string& message) {
  return absl::InvalidArgumentError(absl::StrCat(name, ": ", message));
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  // Row i has the distances of the first i characters of `a` from the first j of `b`; three rows are enough.
  std::vector<std::size_t> row(b.size() + 1), last(b.size() + 1), last_but_one(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], last_but_one[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> NearMatch(std::string_view word, const std::vector<std::string>& candidates) {
  std::optional<std::string> nearest;
  std::size_t least = kMaxEdits + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t shorter = std::min(word.size(), candidate.size());
    if (longer - shorter > kMaxEdits) continue;  // Each further character takes an edit.
    const std::size_t edits = EditDistance(word, candidate);
    if (edits >= least || edits * kCharactersPer > longer * kEditsPer) continue;
    least = edits;
    nearest = candidate;
  }
  return nearest;
}

std::string Suggestion(std::string_view word, const std::vector<std::string>& candidates, std::string_view otherwise) {
  const std::optional<std::string> near = NearMatch(word, candidates);
  return near ? absl::StrCat("; did you mean ", *near, "?") : absl::StrCat("; ", std::string(otherwise));
}

namespace {

// Abseil also reads hexadecimal numbers; in a file of coordinates one is a mistake.
bool IsHexadecimal(std::string_view text) { return text.find_first_of("xX") != std::string_view::npos; }

bool HasDigit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

}  // namespace

std::optional<float> ParseFloat(std::string_view text) {
  float value = 0;
  if (IsHexadecimal(text) || !absl::SimpleAtof(absl::string_view(text.data(), text.size()), &value))
    return std::nullopt;
  const bool overflow = std::isinf(value) && HasDigit(text);
  return overflow ? std::copysign(std::numeric_limits<float>::max(), value) : value;
}

std::optional<double> ParseDouble(std::string_view text) {
  double value = 0;
  if (IsHexadecimal(text) || !absl::SimpleAtod(absl::string_view(text.data(), text.size()), &value))
    return std::nullopt;
  return value;
}

void AppendFloat(float value, std::string& text) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr;
  text.append(digits, end);
}

std::string FormatFloat(float value) {
  std::string text;
  AppendFloat(value, text);
  return text;
}

nlohmann::ordered_json JsonNumber(float value) {
  if (!std::isfinite(value)) return nullptr;
  return *ParseDouble(FormatFloat(value));
}

std::string PercentText(double fraction) {
  const double percent = 100 * fraction;
  return std::abs(percent) < 10 ? absl::StrFormat("%.2g %%", percent) : absl::StrFormat("%.0f %%", percent);
}

std::string OneLine(std::string text) {
  for (char& c : text)
    if ((c >= '\0' && c < ' ') || c == '\x7f') c = '?';
  return text;
}

}  // namespace albtpu::formats
