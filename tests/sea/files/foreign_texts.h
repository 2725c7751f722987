// Texts of foreign files of the sea: changed, and what was read from them.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "sea/files/sea_series.h"

namespace albtpu {

inline std::string Replaced(std::string text, std::string_view what, std::string_view with) {
  return text.replace(text.find(what), what.size(), with);
}

inline const BinnedSpectrum& Bins(const SeaRecord& record) { return *std::get<BinnedWaves>(record.waves); }

}  // namespace albtpu
