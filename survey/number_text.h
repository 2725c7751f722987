// Numbers as text, without a locale: what a file says is read once into single precision, and what is written
// reads back to the same value.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace albtpu::client {

// The float32 nearest to a decimal number, `nan`, `inf` or `infinity` (any case), with spaces around it
// allowed; nothing when the text is anything else. A number beyond the range of float32 is the largest that
// there is: out of domain, not infinite.
std::optional<float> ParseFloat(std::string_view text);

// The same in double precision, but an infinity beyond its range.
std::optional<double> ParseDouble(std::string_view text);

// Nine significant digits, enough to read back to the same float32: 0.3 is "0.300000012". Requires a finite
// value.
std::string FormatFloat(float value);

// The same behind `text`.
void AppendFloat(float value, std::string& text);

// The number that JSON prints with the digits of FormatFloat; null when it is not finite.
nlohmann::ordered_json JsonNumber(float value);

}  // namespace albtpu::client
