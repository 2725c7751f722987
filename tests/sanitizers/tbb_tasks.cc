// Tells ThreadSanitizer what oneTBB orders between threads.
//
// Debian's oneTBB is not compiled for it: that what a thread wrote before it gave a task away is there for the thread
// that has it, and what that wrote for the one that waits, is done by atomic numbers within the library. Linked into a
// program, these functions stand before those of the library, which they call.
#include <oneapi/tbb/detail/_small_object_pool.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sanitizer/tsan_interface.h>

#include "tests/sanitizers/next_function.h"

namespace {

using tbb::detail::d1::execution_data;
using tbb::detail::d1::task;

// A task in place of another: comes after what its giver did.
class GivenTask final : public task {
 public:
  explicit GivenTask(task& given) : given_(given) { __tsan_release(this); }

  // The library cancels what failed with an exception, so that this is there until then.
  task* execute(execution_data& data) override {
    __tsan_acquire(this);
    task* const next = given_.execute(data);
    delete this;
    return next;
  }
  task* cancel(execution_data& data) override {
    __tsan_acquire(this);
    task* const next = given_.cancel(data);
    delete this;
    return next;
  }

 private:
  task& given_;
};

// Who waits looks at the count of what is left within the library. This looks at it once more, where it is seen, also
// when a task failed with an exception.
class LastLook {
 public:
  explicit LastLook(tbb::detail::d1::wait_context& wait) : wait_(wait) {}
  ~LastLook() { wait_.reserve(0); }

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

void spawn(task& given, task_group_context& context) {
  static const auto next = NextFunction<void(task&, task_group_context&)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  next(*new GivenTask(given), context);
}

void spawn(task& given, task_group_context& context, slot_id slot) {
  static const auto next = NextFunction<void(task&, task_group_context&, slot_id)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  next(*new GivenTask(given), context, slot);
}

void enqueue(task& given, task_arena_base* arena) {
  static const auto next = NextFunction<void(task&, task_arena_base*)>(
      "_ZN3tbb6detail2r17enqueueERNS0_2d14taskEPNS2_15task_arena_baseE");
  next(*new GivenTask(given), arena);
}

void enqueue(task& given, task_group_context& context, task_arena_base* arena) {
  static const auto next = NextFunction<void(task&, task_group_context&, task_arena_base*)>(
      "_ZN3tbb6detail2r17enqueueERNS0_2d14taskERNS2_18task_group_contextEPNS2_15task_arena_baseE");
  next(*new GivenTask(given), context, arena);
}

void execute_and_wait(task& first, task_group_context& first_context, wait_context& wait,
                      task_group_context& wait_context) {
  static const auto next = NextFunction<void(task&, task_group_context&, d1::wait_context&,
                                             task_group_context&)>(
      "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
  const LastLook look(wait);
  next(first, first_context, wait, wait_context);
}

void wait(wait_context& wait, task_group_context& context) {
  static const auto next = NextFunction<void(wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
  const LastLook look(wait);
  next(wait, context);
}

// The memory of a task goes from thread to thread without malloc().
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
