// What program this is: printed by `--version`, recorded in the provenance of every table.
#pragma once

#include <string_view>

namespace albtpu {

std::string_view Version();  // "0.1.0"
std::string_view
Commit();  // "1a2b3c4d5e6f", "-dirty" after it if the tree was changed, "unknown" outside git.

}  // namespace albtpu
