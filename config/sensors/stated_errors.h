// Standard deviations of the sources of error (budget/air/air_errors.h) as TOML states them: in a sensor file and under
// [sigma] of a survey file.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "budget/air/air_errors.h"
#include "config/toml/toml_keys.h"

namespace albtpu::config {

// Those of some sources; of the others, `values` says nothing.
struct StatedErrors {
  AirErrors values;
  std::array<bool, kErrorSourceCount> stated = {};  // In the order of kErrorSources.

  bool any() const { return std::ranges::find(stated, true) != stated.end(); }
  template <typename Member>
  bool Has(Member AirErrors::*source) const {
    return stated[Index(source)];
  }
};

// "[north, east, down]", of a source with three numbers.
std::string PartsText(const ErrorSource& source);

// Degree. The best of airborne systems know roll and pitch to 0.0025 degrees, which are 4.4e-5 rad. An angle between 0
// and this was meant in radians.
inline constexpr double kLeastAngle = 2e-4;

// Reads what `key` has of source `i` of kErrorSources: its number or its three numbers, each from 0 to the greatest
// plausible; 0 is none. Not stated if the key is missing or a problem.
void ReadErrors(config::TomlKeys& keys, std::string_view key, std::size_t i, StatedErrors& errors);

}  // namespace albtpu::config
