// Lets oneTBB allocate its memory where sanitizers see it.
//
// Its own allocator, tbbmalloc, passes memory freed by one thread to another without the sanitizers' knowledge, and
// they do not detect accesses beyond a block or after it was freed. Linked into a program, these functions replace
// those of the library; the library itself calls them, too.
#include <oneapi/tbb/cache_aligned_allocator.h>

#include <new>

#ifdef _GLIBCXX_TSAN
extern "C" void AnnotateIgnoreWritesBegin(const char* file, int line);
extern "C" void AnnotateIgnoreWritesEnd(const char* file, int line);
#endif

namespace {

// Makes ThreadSanitizer ignore writes: much of this memory is the library's own, which synchronizes its use invisibly.
struct Unwatched {
#ifdef _GLIBCXX_TSAN
  Unwatched() { AnnotateIgnoreWritesBegin(__FILE__, __LINE__); }
  ~Unwatched() { AnnotateIgnoreWritesEnd(__FILE__, __LINE__); }
#else
  Unwatched() {}
#endif
};

// As in the library: two adjacent cache lines, which are fetched together.
constexpr std::align_val_t kLine{128};

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
