// The memory that a test takes: this library replaces the global operators new and delete, and counts.
#pragma once

#include <cstddef>

namespace albtpu::testing {

// Begins to count anew; what is allocated now counts as nothing.
void ResetMostAllocated();
// Bytes that were allocated at a time, at most.
std::size_t MostAllocated();

}  // namespace albtpu::testing
