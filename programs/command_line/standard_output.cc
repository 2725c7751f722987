#include "programs/command_line/standard_output.h"

#include <cstdio>
#include <iostream>

namespace albtpu::programs {

absl::Status FlushStandardOutput() {
  const bool streamed = static_cast<bool>(std::cout.flush());
  const bool printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (streamed && printed) return absl::OkStatus();
  return absl::DataLossError("standard output: cannot be written; redirect it to a place with free space");
}

}  // namespace albtpu::programs
