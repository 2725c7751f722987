#include "formats/text/number_text.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "absl/strings/numbers.h"
#include "absl/strings/string_view.h"

namespace albtpu::formats {

namespace {

// Abseil also reads hexadecimal numbers; in a file of coordinates one is a mistake.
bool IsHexadecimal(std::string_view text) { return text.find_first_of("xX") != std::string_view::npos; }

bool HasDigit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

}  // namespace

std::optional<float> ParseFloat(std::string_view text) {
  float value = 0;
  if (IsHexadecimal(text) || !absl::SimpleAtof(absl::string_view(text.data(), text.size()), &value)) {
    return std::nullopt;
  }
  const bool overflow = std::isinf(value) && HasDigit(text);
  return overflow ? std::copysign(std::numeric_limits<float>::max(), value) : value;
}

std::optional<double> ParseDouble(std::string_view text) {
  double value = 0;
  if (IsHexadecimal(text) || !absl::SimpleAtod(absl::string_view(text.data(), text.size()), &value)) {
    return std::nullopt;
  }
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

}  // namespace albtpu::formats
