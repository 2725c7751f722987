// The keys of the survey file. Each is declared once, in the table of its section (survey_settings.h, sea_settings.h):
// from it come reading TOML, the flag of the same meaning with its range and help, messages, `albtpu-query keys` and
// docs/survey.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "config/toml/toml_keys.h"

namespace albtpu::config {

using Triple = std::array<double, 3>;

// What a key takes. `shown` stands for the value in --help.
struct Number {
  double least, greatest;
  std::string_view unit;  // "1": none
};
struct ThreeNumbers {
  double least, greatest;
  std::string_view unit, parts, shown;  // parts: "[forward, right, down]"
};
struct Word {
  std::span<const std::string_view> words;
};
struct Text {
  std::string_view what, shown;  // what: "a name, or \"LAT,LON\""
};
struct Path {
  std::string_view what, shown;
};
struct Paths {};
struct NumberOrPath {
  Number number;
  std::string_view what, shown;
};
struct WholeNumbers {
  int least, greatest;
};
struct YesOrNo {};
using KeyValues = std::variant<Number, ThreeNumbers, Word, Text, Path, Paths, NumberOrPath, WholeNumbers, YesOrNo>;

struct KeyDeclaration {
  std::string_view key, flag;  // flag: empty where there is none
  KeyValues values;
  std::string_view absent;  // What is taken where it is not given, for people; empty: nothing.
  std::string_view help;
};

using Level = std::variant<double, std::string>;  // A height, or the path of a file of heights.

// A key with its place in the settings of its section.
template <typename Settings>
struct Key {
  KeyDeclaration declaration;
  std::variant<std::optional<double> Settings::*, std::optional<std::string> Settings::*,
               std::optional<bool> Settings::*, std::optional<Triple> Settings::*, std::optional<Level> Settings::*,
               std::vector<int> Settings::*, std::vector<std::string> Settings::*>
      member;
};

using Value =
    std::variant<std::monostate, double, std::string, bool, Triple, std::vector<int>, std::vector<std::string>>;

// The value of a key of a file; none if the key is missing, or a problem, which `keys` remembers. Paths count from
// `folder`.
Value ReadValue(TomlKeys& keys, const KeyDeclaration& key, const std::filesystem::path& folder);

// What the flag of a key says. InvalidArgument "is '110' (expected 0 to 30 m); ...", without the flag's name.
absl::StatusOr<Value> ParseValue(const KeyDeclaration& key, std::string_view text);

// "a number from 0 to 100 m/s"
std::string RangeText(const Number& range);

template <typename Settings>
void Put(const Value& value, const Key<Settings>& key, Settings& settings) {
  std::visit(
      [&](const auto& given, const auto member) {
        if constexpr (std::is_assignable_v<decltype(settings.*member), decltype(given)>) settings.*member = given;
      },
      value, key.member);
}

template <typename Table, typename Settings>
void ReadKeys(TomlKeys& keys, const Table& table, const std::filesystem::path& folder, Settings& settings) {
  for (const Key<Settings>& key : table) Put(ReadValue(keys, key.declaration, folder), key, settings);
}

template <typename Settings>
bool IsGiven(const Key<Settings>& key, const Settings& settings) {
  const auto is_given = []<typename Member>(const Member& member) {
    if constexpr (requires { member.has_value(); })
      return member.has_value();
    else
      return !member.empty();
  };
  return std::visit([&](const auto member) { return is_given(settings.*member); }, key.member);
}

template <typename Table, typename Settings>
bool IsAnyGiven(const Table& table, const Settings& settings) {
  for (const Key<Settings>& key : table)
    if (IsGiven(key, settings)) return true;
  return false;
}

// Takes what `flags` give in place of what `settings` have.
template <typename Table, typename Settings>
void Override(const Table& table, const Settings& flags, Settings& settings) {
  for (const Key<Settings>& key : table)
    if (IsGiven(key, flags)) std::visit([&](const auto member) { settings.*member = flags.*member; }, key.member);
}

}  // namespace albtpu::config
