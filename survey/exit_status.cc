#include "survey/exit_status.h"

#include <cstdio>
#include <iostream>
#include <string>

#include "absl/strings/cord.h"
#include "service/printable_text.h"
#include "survey/error_details.h"

namespace albtpu::client {
namespace {

constexpr char kUsagePayload[] = "albtpu/usage";

}  // namespace

absl::Status UsageError(std::string_view message) {
  absl::Status status = absl::InvalidArgumentError(absl::string_view(message.data(), message.size()));
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

bool IsUsageError(const absl::Status& status) { return status.GetPayload(kUsagePayload).has_value(); }

int Report(const absl::Status& status) {
  if (status.ok()) return 0;
  Note(MessageWithDetails(status));
  return IsUsageError(status) ? kExitUsage : kExitFailure;
}

absl::Status FlushAnswers() {
  if (std::cout.flush()) return absl::OkStatus();
  return absl::DataLossError("standard output: cannot be written: send it where there is room");
}

void Note(std::string_view message, const std::string& below) {
  std::fprintf(stderr, "albtpu-query: %s%s\n", PrintableText(message).c_str(), below.c_str());
}

}  // namespace albtpu::client
