// Memory that is freed stays with the process.
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <thread>

namespace albtpu {

// To be called first in main() by programs that allocate and free messages of megabytes all the time. By
// default glibc gives such blocks back to the system at once, and page faults then cost twice what the
// messages do. What is kept is at most what was in use at a time. Elsewhere than on glibc this does nothing.
inline void KeepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // The most that glibc takes; longer than any message.
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
  // By default eight for each core, and each keeps the most that was ever in use in it.
  mallopt(M_ARENA_MAX, static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
#endif
}

// To be called once a minute or so: gives back to the system what is free. What messages need is in use again
// within moments; what a busier time needed is not kept for ever.
inline void ReturnFreedMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace albtpu
