// Tells ThreadSanitizer about the synchronization by gRPC: what a thread did before it started an operation happens
// before the operation's tag is returned from a queue, and what a call did happens before the server is destroyed.
//
// Debian's gRPC is not compiled for ThreadSanitizer and passes operations on through atomics inside the library. Linked
// into a program, these functions replace those of the library and call them.
#include <grpc/grpc.h>
#include <grpcpp/support/server_callback.h>
#include <sanitizer/tsan_interface.h>

#include "tests/sanitizers/next_function.h"

namespace {

using albtpu::sanitizers::NextFunction;

char ended_calls;  // Only its address is used.

// Passes on an event that a queue returned.
grpc_event Acquired(const grpc_event& event) {
  if (event.type == GRPC_OP_COMPLETE) __tsan_acquire(event.tag);
  return event;
}

}  // namespace

grpc_call_error grpc_call_start_batch(grpc_call* call, const grpc_op* operations, size_t count, void* tag,
                                      void* reserved) {
  static const auto next = NextFunction<decltype(grpc_call_start_batch)>("grpc_call_start_batch");
  if (tag != nullptr) __tsan_release(tag);
  return next(call, operations, count, tag, reserved);
}

grpc_call_error grpc_server_request_call(grpc_server* server, grpc_call** call, grpc_call_details* details,
                                         grpc_metadata_array* metadata, grpc_completion_queue* call_queue,
                                         grpc_completion_queue* queue, void* tag) {
  static const auto next = NextFunction<decltype(grpc_server_request_call)>("grpc_server_request_call");
  __tsan_release(tag);
  return next(server, call, details, metadata, call_queue, queue, tag);
}

void grpc_server_shutdown_and_notify(grpc_server* server, grpc_completion_queue* queue, void* tag) {
  static const auto next = NextFunction<decltype(grpc_server_shutdown_and_notify)>("grpc_server_shutdown_and_notify");
  __tsan_release(tag);
  next(server, queue, tag);
}

grpc_event grpc_completion_queue_next(grpc_completion_queue* queue, gpr_timespec deadline, void* reserved) {
  static const auto next = NextFunction<decltype(grpc_completion_queue_next)>("grpc_completion_queue_next");
  return Acquired(next(queue, deadline, reserved));
}

grpc_event grpc_completion_queue_pluck(grpc_completion_queue* queue, void* tag, gpr_timespec deadline, void* reserved) {
  static const auto next = NextFunction<decltype(grpc_completion_queue_pluck)>("grpc_completion_queue_pluck");
  return Acquired(next(queue, tag, deadline, reserved));
}

void grpc_call_unref(grpc_call* call) {
  static const auto next = NextFunction<decltype(grpc_call_unref)>("grpc_call_unref");
  __tsan_release(&ended_calls);
  next(call);
}

void grpc_server_destroy(grpc_server* server) {
  static const auto next = NextFunction<decltype(grpc_server_destroy)>("grpc_server_destroy");
  next(server);
  __tsan_acquire(&ended_calls);
}

// Happens after all callbacks of the call: each decremented the counter of outstanding callbacks, some of them inside
// the library.
void grpc::internal::ServerCallbackCall::ScheduleOnDone(bool within) {
  static const auto next =
      NextFunction<void(ServerCallbackCall*, bool)>("_ZN4grpc8internal18ServerCallbackCall14ScheduleOnDoneEb");
  callbacks_outstanding_.load(std::memory_order_acquire);
  next(this, within);
}
