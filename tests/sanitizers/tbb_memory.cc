// The memory of oneTBB, from where sanitizers see it.
//
// Its own allocator, tbbmalloc, gives memory that one thread freed to another unseen, and what is read or written
// beside it, or after it was freed, goes unnoticed. Linked into a program, these functions stand before those of the
// library, which calls them too.
#include <oneapi/tbb/cache_aligned_allocator.h>

#include <new>

#ifdef _GLIBCXX_TSAN
extern "C" void AnnotateIgnoreWritesBegin(const char* file, int line);
extern "C" void AnnotateIgnoreWritesEnd(const char* file, int line);
#endif

namespace {

// While ThreadSanitizer looks away: much of this memory is the library's own, and used by it in an order unseen.
struct Unwatched {
#ifdef _GLIBCXX_TSAN
  Unwatched() { AnnotateIgnoreWritesBegin(__FILE__, __LINE__); }
  ~Unwatched() { AnnotateIgnoreWritesEnd(__FILE__, __LINE__); }
#else
  Unwatched() {}
#endif
};

constexpr std::align_val_t kLine{128};  // As in the library: two lines of the cache, which come together.

}  // namespace

namespace tbb::detail::r1 {

void* cache_aligned_allocate(std::size_t bytes) {
  const Unwatched unwatched;
  return ::operator new(bytes, kLine);
}

void cache_aligned_deallocate(void* memory) {
  const Unwatched unwatched;
  ::operator delete(memory, kLine);
}

void* allocate_memory(std::size_t bytes) {
  const Unwatched unwatched;
  return ::operator new(bytes);
}

void deallocate_memory(void* memory) {
  const Unwatched unwatched;
  ::operator delete(memory);
}

}  // namespace tbb::detail::r1
