// Shared by all fuzz targets: the entry point, and how a target reports a fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "absl/status/status.h"

// Called with arbitrary bytes. The target checks what must hold for all of them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace albtpu::fuzz {

// Aborts if the condition is false, also in builds without assertions.
#define ALBTPU_MUST(condition)                                                            \
  do {                                                                                    \
    if (!(condition)) {                                                                   \
      std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                       \
    }                                                                                     \
  } while (false)

// The status of a file that is refused: of its kind, with some words.
inline void MustExplain(const absl::Status& status) {
  ALBTPU_MUST(absl::IsInvalidArgument(status) || absl::IsDataLoss(status) || absl::IsUnimplemented(status));
  ALBTPU_MUST(status.message().size() > 20);
}

}  // namespace albtpu::fuzz
