#include "service/server/ground/status.h"

#include <spdlog/spdlog.h>

#include <string>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "google/rpc/status.pb.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

// In UTF-8: no character is cut in two.
std::string Shortened(absl::string_view message) {
  if (message.size() <= kMaxErrorBytes) return std::string(message);
  std::size_t size = kMaxErrorBytes;
  while (size > 0 && (static_cast<unsigned char>(message[size]) & 0xC0) == 0x80) --size;
  return std::string(message.substr(0, size)) + "...";
}

grpc::Status ForCaller(const absl::Status& status) {
  google::rpc::Status rich;
  status.ForEachPayload([&rich](absl::string_view type_url, const absl::Cord& payload) {
    if (!absl::StartsWith(type_url, "type.googleapis.com/")) return;
    google::protobuf::Any& detail = *rich.add_details();
    detail.set_type_url(std::string(type_url));
    detail.set_value(std::string(payload));
  });
  // The numbers of the codes are the same by definition.
  const auto code = static_cast<grpc::StatusCode>(status.code());
  const std::string message = Shortened(status.message());
  if (rich.details().empty()) return grpc::Status(code, message);
  rich.set_code(code);
  rich.set_message(message);
  return grpc::Status(code, message, rich.SerializeAsString());
}

}  // namespace

grpc::Status ToGrpcStatus(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return grpc::Status::OK;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kPermissionDenied:
    case absl::StatusCode::kResourceExhausted:  // Of limits.h.
    case absl::StatusCode::kDeadlineExceeded:   // Of limits.h, or the caller's.
    case absl::StatusCode::kCancelled:          // By the caller.
    case absl::StatusCode::kUnavailable:        // The request did not arrive whole.
      return ForCaller(status);
    default:
      spdlog::error("call failed: {}", status.ToString());
      return grpc::Status(grpc::StatusCode::INTERNAL, "internal error: the log of the server says more");
  }
}

}  // namespace albtpu::server
