// The version of the program, printed by `--version` and recorded in the provenance of every table.
#pragma once

#include <string_view>

namespace albtpu {

std::string_view Version();  // "1.0.0", or before it "1.0.0-rc1"
// "1a2b3c4d5e6f", with "-dirty" appended if the working tree had changes; "unknown" outside of git.
std::string_view Commit();

}  // namespace albtpu
