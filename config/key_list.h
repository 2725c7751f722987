// All keys of the survey file, for people and for programs that describe them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/key.h"

namespace albtpu::config {

// What a key takes, in words.
struct ValueFacts {
  std::string type;  // "number", "3 numbers", "one of", "text", "path", "paths", "number or path" ...
  std::string unit;  // empty: none
  std::optional<double> least, greatest;  // of numbers
  std::vector<std::string> words;         // of which it is one
  std::string shown;                      // in --help: "NUMBER"
};
ValueFacts FactsOf(const KeyValues& values);

struct ListedKey {
  std::string section;  // "sea.waves"
  std::string key, flag, absent, help;
  ValueFacts values;
};

// By section, in the order of the tables.
std::vector<ListedKey> ListKeys();

// Whether a survey file may have any number of tables of this name: [[sea.waves]].
inline bool IsOfMany(std::string_view section) { return section == "sea.waves" || section == "sensor.channel"; }

// "Depth of the water that the waves travel in [m] (default: ...)"
std::string HelpText(const KeyDeclaration& key);

// "0.1 to 20000", "relax, wind, level, none"; empty where every value is taken.
std::string RangeText(const ValueFacts& values);

}  // namespace albtpu::config
