// Memory that is freed stays with the process.
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace albtpu {

// To be called first in main() by programs that allocate and free messages of megabytes all the time. By
// default glibc gives such blocks back to the system at once, and page faults then cost twice what the
// messages do. What is kept is at most what was in use at a time. Elsewhere this does nothing.
inline void KeepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // The most that glibc takes; longer than any message.
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

}  // namespace albtpu
