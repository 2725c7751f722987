#include "command_line/exit_codes.h"

#include "absl/strings/cord.h"

namespace albtpu {
namespace {

constexpr char kUsagePayload[] = "albtpu/usage";

}  // namespace

absl::Status UsageError(std::string_view message) {
  absl::Status status = absl::InvalidArgumentError(absl::string_view(message.data(), message.size()));
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

bool IsUsageError(const absl::Status& status) { return status.GetPayload(kUsagePayload).has_value(); }

}  // namespace albtpu
