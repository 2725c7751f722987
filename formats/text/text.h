// Numbers, names and errors as text for the messages of all programs, which are one line each, and their exit codes.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"

namespace albtpu::formats {

// Exit codes of all programs, and the error whose exit code is that of bad usage.

// 0 is success.
inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;  // arguments that the program does not take

// An InvalidArgument whose cause is the command line, rather than a file or a server.
absl::Status UsageError(std::string_view message);
bool IsUsageError(const absl::Status& status);

// "<name>: <message>", an InvalidArgument: what a file has cannot be used.
absl::Status InvalidFile(const std::string& name, const std::string& message);

// Finds the known word that a misspelt one probably stands for.

// The number of edits that turn `a` into `b`: a character inserted, deleted or replaced, or two neighbours swapped
// (the optimal string alignment distance, which edits no substring twice).
std::size_t EditDistance(std::string_view a, std::string_view b);

// The candidate nearest to `word`, the first of several that are equally near. None if even the nearest takes more than
// two edits for every five characters of the longer word, or more than three in all.
std::optional<std::string> NearMatch(std::string_view word, const std::vector<std::string>& candidates);

// "; did you mean X?" if X is a near match, otherwise "; " and `otherwise`.
std::string Suggestion(std::string_view word, const std::vector<std::string>& candidates, std::string_view otherwise);

// Numbers as text, independent of the locale. A number in a file is rounded once, to single precision; a number
// that is written reads back to the same value.

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

// Fractions as text in per cent.

// "0.28 %", "18 %": two significant digits, and all digits before the point.
std::string PercentText(double fraction);

// Texts of files in messages, which are one line.

// Control characters become question marks. TOML allows them in keys and texts, and its parser quotes them.
std::string OneLine(std::string text);

}  // namespace albtpu::formats
