// The fields that a refused request names.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "google/rpc/error_details.pb.h"

namespace albtpu::server {

// The paths of the wrong fields; none if `status` is OK.
inline std::vector<std::string> WrongFields(const absl::Status& status) {
  const auto payload = status.GetPayload("type.googleapis.com/google.rpc.BadRequest");
  google::rpc::BadRequest request;
  std::vector<std::string> paths;
  if (!payload.has_value() || !request.ParseFromString(std::string(*payload))) return paths;
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  for (const auto& violation : request.field_violations()) {
    EXPECT_THAT(violation.description(), ::testing::HasSubstr(violation.field()));
    paths.push_back(violation.field());
  }
  return paths;
}

}  // namespace albtpu::server
