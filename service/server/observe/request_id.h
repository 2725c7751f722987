// What a call is called in the log.
#pragma once

#include <grpcpp/grpcpp.h>

#include <string>
#include <string_view>

namespace albtpu::server {

// The metadata `x-request-id` of a caller who sends one; else, and in place of one that no log should carry,
// 16 random hexadecimal digits. Found or made when it is first asked for: most calls are never logged.
class RequestId {
 public:
  static constexpr char kMetadata[] = "x-request-id";

  explicit RequestId(const grpc::CallbackServerContext& context) : context_(context) {}

  // The same text always. For one thread at a time.
  const std::string& text() const;

  // 1 to 64 letters, digits and any of ._-
  static bool IsSane(std::string_view text);

 private:
  const grpc::CallbackServerContext& context_;
  mutable std::string text_;
};

}  // namespace albtpu::server
