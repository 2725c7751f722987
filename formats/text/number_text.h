// Numbers as text, independent of the locale. A number in a file is rounded once, to single precision; a number
// that is written reads back to the same value.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace albtpu::formats {

// The float32 nearest to a decimal number, `nan`, `inf` or `infinity` (any case), which may have spaces around
// it; nullopt for any other text. A finite number beyond the range of float32 becomes the largest float32 of its
// sign: it is out of domain, not infinite.
std::optional<float> ParseFloat(std::string_view text);

// The same in double precision, except that a number beyond its range becomes infinite.
std::optional<double> ParseDouble(std::string_view text);

// Nine significant digits, enough to read back the same float32: 0.3 is "0.300000012". Requires a finite value.
std::string FormatFloat(float value);

// Appends FormatFloat(value) to `text`.
void AppendFloat(float value, std::string& text);

// The number that JSON prints with the digits of FormatFloat; null when it is not finite.
nlohmann::ordered_json JsonNumber(float value);

}  // namespace albtpu::formats
