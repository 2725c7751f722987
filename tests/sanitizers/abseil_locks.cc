// Tells ThreadSanitizer about the synchronization by Abseil's locks, which gRPC uses.
//
// Debian's Abseil and gRPC are not compiled for ThreadSanitizer, and their locks use atomics rather than pthreads.
// Without this it would not know that what one thread wrote before handing a call to gRPC is visible to the thread on
// which gRPC calls us. Linked into a program, these functions replace those of the libraries and call them.
#include <absl/synchronization/mutex.h>
#include <sanitizer/tsan_interface.h>

#include "tests/sanitizers/next_function.h"

namespace absl {
ABSL_NAMESPACE_BEGIN

using albtpu::sanitizers::NextMember;

void Mutex::Lock() {
  static const auto lock = NextMember<Mutex, void(Mutex*)>("4LockEv");
  lock(this);
  __tsan_acquire(this);
}

bool Mutex::TryLock() {
  static const auto try_lock = NextMember<Mutex, bool(Mutex*)>("7TryLockEv");
  const bool locked = try_lock(this);
  if (locked) __tsan_acquire(this);
  return locked;
}

void Mutex::Unlock() {
  static const auto unlock = NextMember<Mutex, void(Mutex*)>("6UnlockEv");
  __tsan_release(this);
  unlock(this);
}

#if ABSL_LTS_RELEASE_VERSION == 20220623
void CondVar::Wait(Mutex* mutex) {
  static const auto wait = NextMember<CondVar, void(CondVar*, Mutex*)>("4WaitEPNS0_5MutexE");
  __tsan_release(mutex);
  wait(this, mutex);
  __tsan_acquire(mutex);
}

bool CondVar::WaitWithDeadline(Mutex* mutex, Time deadline) {
  static const auto wait =
      NextMember<CondVar, bool(CondVar*, Mutex*, Time)>("16WaitWithDeadlineEPNS0_5MutexENS0_4TimeE");
  __tsan_release(mutex);
  const bool expired = wait(this, mutex, deadline);
  __tsan_acquire(mutex);
  return expired;
}

bool CondVar::WaitWithTimeout(Mutex* mutex, Duration timeout) {
  static const auto wait =
      NextMember<CondVar, bool(CondVar*, Mutex*, Duration)>("15WaitWithTimeoutEPNS0_5MutexENS0_8DurationE");
  __tsan_release(mutex);
  const bool expired = wait(this, mutex, timeout);
  __tsan_acquire(mutex);
  return expired;
}
#else
// In later versions the others are inline and call this one.
bool CondVar::WaitCommon(Mutex* mutex, synchronization_internal::KernelTimeout timeout) {
  static const auto wait = NextMember<CondVar, bool(CondVar*, Mutex*, synchronization_internal::KernelTimeout)>(
      "10WaitCommonEPNS0_5MutexENS0_24synchronization_internal13KernelTimeoutE");
  __tsan_release(mutex);
  const bool expired = wait(this, mutex, timeout);
  __tsan_acquire(mutex);
  return expired;
}
#endif

ABSL_NAMESPACE_END
}  // namespace absl
