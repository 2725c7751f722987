// What program this is: printed by `--version`, recorded in the provenance of every table.
#pragma once

#include <string_view>

namespace albtpu {

std::string_view Version();  // "0.1.0"
// "1a2b3c4d5e6f", "-dirty" behind it if the tree was changed, "unknown" outside git.
std::string_view Commit();

}  // namespace albtpu
