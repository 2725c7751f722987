// Errors about bytes that contradict each other.
#pragma once

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace albtpu::laz {

inline constexpr char kGetAnotherCopy[] = "; get another copy of the file";

// DataLoss; `problem` in pieces, as for StrCat().
template <typename... Pieces>
absl::Status Damaged(const Pieces&... problem) {
  return absl::DataLossError(absl::StrCat(problem..., kGetAnotherCopy));
}

}  // namespace albtpu::laz
