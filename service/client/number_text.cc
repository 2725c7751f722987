#include "service/client/number_text.h"

#include <charconv>

#include "absl/strings/numbers.h"
#include "absl/strings/string_view.h"

namespace albtpu::client {

std::optional<float> ParseFloat(std::string_view text) {
  float value = 0;
  if (!absl::SimpleAtof(absl::string_view(text.data(), text.size()), &value)) return std::nullopt;
  return value;
}

std::optional<double> ParseDouble(std::string_view text) {
  double value = 0;
  if (!absl::SimpleAtod(absl::string_view(text.data(), text.size()), &value)) return std::nullopt;
  return value;
}

std::string FormatFloat(float value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr;
  return std::string(digits, end);
}

}  // namespace albtpu::client
