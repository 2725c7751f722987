// Tells ThreadSanitizer about the synchronization by oneTBB tasks.
//
// Debian's oneTBB is not compiled for ThreadSanitizer. Atomics inside the library ensure that what a thread wrote
// before it spawned a task is visible to the thread that runs the task, and what the task wrote to the thread that
// waits for it. Linked into a program, these functions replace those of the library and call them.
#include <oneapi/tbb/detail/_small_object_pool.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sanitizer/tsan_interface.h>

#include "tests/sanitizers/next_function.h"

namespace {

using tbb::detail::d1::execution_data;
using tbb::detail::d1::task;

// Wraps a task: it happens after what its spawner did.
class WatchedTask final : public task {
 public:
  explicit WatchedTask(task& original) : original_(original) { __tsan_release(this); }

  // When a task throws, the library cancels it, so that this object lives until then.
  task* execute(execution_data& data) override {
    __tsan_acquire(this);
    task* const next = original_.execute(data);
    delete this;
    return next;
  }
  task* cancel(execution_data& data) override {
    __tsan_acquire(this);
    task* const next = original_.cancel(data);
    delete this;
    return next;
  }

 private:
  task& original_;
};

// A waiting thread reads the counter of remaining work inside the library. This accesses it once more where
// ThreadSanitizer sees it, also when a task threw an exception.
class VisibleWait {
 public:
  explicit VisibleWait(tbb::detail::d1::wait_context& wait) : wait_(wait) {}
  ~VisibleWait() { wait_.reserve(0); }

 private:
  tbb::detail::d1::wait_context& wait_;
};

}  // namespace

namespace tbb::detail::r1 {

using albtpu::sanitizers::NextFunction;
using d1::slot_id;
using d1::small_object_pool;
using d1::task_arena_base;
using d1::task_group_context;
using d1::wait_context;

void spawn(task& original, task_group_context& context) {
  static const auto next = NextFunction<void(task&, task_group_context&)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  next(*new WatchedTask(original), context);
}

void spawn(task& original, task_group_context& context, slot_id slot) {
  static const auto next = NextFunction<void(task&, task_group_context&, slot_id)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  next(*new WatchedTask(original), context, slot);
}

void enqueue(task& original, task_arena_base* arena) {
  static const auto next =
      NextFunction<void(task&, task_arena_base*)>("_ZN3tbb6detail2r17enqueueERNS0_2d14taskEPNS2_15task_arena_baseE");
  next(*new WatchedTask(original), arena);
}

void enqueue(task& original, task_group_context& context, task_arena_base* arena) {
  static const auto next = NextFunction<void(task&, task_group_context&, task_arena_base*)>(
      "_ZN3tbb6detail2r17enqueueERNS0_2d14taskERNS2_18task_group_contextEPNS2_15task_arena_baseE");
  next(*new WatchedTask(original), context, arena);
}

void execute_and_wait(task& first, task_group_context& first_context, wait_context& wait,
                      task_group_context& wait_context) {
  static const auto next = NextFunction<void(task&, task_group_context&, d1::wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
  const VisibleWait visible(wait);
  next(first, first_context, wait, wait_context);
}

void wait(wait_context& wait, task_group_context& context) {
  static const auto next = NextFunction<void(wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
  const VisibleWait visible(wait);
  next(wait, context);
}

// The memory of a task passes from thread to thread without malloc().
void* allocate(small_object_pool*& pool, std::size_t bytes) {
  static const auto next = NextFunction<void*(small_object_pool*&, std::size_t)>(
      "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm");
  void* const memory = next(pool, bytes);
  __tsan_acquire(memory);
  return memory;
}

void* allocate(small_object_pool*& pool, std::size_t bytes, const execution_data& data) {
  static const auto next = NextFunction<void*(small_object_pool*&, std::size_t, const execution_data&)>(
      "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE");
  void* const memory = next(pool, bytes, data);
  __tsan_acquire(memory);
  return memory;
}

void deallocate(small_object_pool& pool, void* memory, std::size_t bytes) {
  static const auto next = NextFunction<void(small_object_pool&, void*, std::size_t)>(
      "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvm");
  __tsan_release(memory);
  next(pool, memory, bytes);
}

void deallocate(small_object_pool& pool, void* memory, std::size_t bytes, const execution_data& data) {
  static const auto next = NextFunction<void(small_object_pool&, void*, std::size_t, const execution_data&)>(
      "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE");
  __tsan_release(memory);
  next(pool, memory, bytes, data);
}

}  // namespace tbb::detail::r1
