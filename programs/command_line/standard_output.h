// The end of standard output.
#pragma once

#include "absl/status/status.h"

namespace albtpu::programs {

// Flushes standard output. DataLoss if any of what was printed could not be written, to a full disk for example.
absl::Status FlushStandardOutput();

}  // namespace albtpu::programs
