#include "formats/text/usage_error.h"

#include "absl/strings/cord.h"

namespace albtpu::formats {
namespace {

constexpr char kUsagePayload[] = "albtpu/usage";

}  // namespace

absl::Status UsageError(std::string_view message) {
  absl::Status status = absl::InvalidArgumentError(absl::string_view(message.data(), message.size()));
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

bool IsUsageError(const absl::Status& status) { return status.GetPayload(kUsagePayload).has_value(); }

}  // namespace albtpu::formats
