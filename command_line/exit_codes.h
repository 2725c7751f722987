// Exit codes of all programs; 0 is success.
#pragma once

namespace albtpu {

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;  // arguments that the program does not take

}  // namespace albtpu
