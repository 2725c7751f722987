// Text that may be compressed by gzip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_limits.h"

namespace albtpu {

bool IsGzip(std::string_view bytes);

// Inflates one or more gzip streams that follow each other. More than `most` bytes are refused.
absl::StatusOr<std::string> Inflated(std::string_view bytes, std::size_t most = kMaxSeaBytes);

}  // namespace albtpu
