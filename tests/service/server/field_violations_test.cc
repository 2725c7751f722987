#include "service/server/tables/field_violations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "google/rpc/status.pb.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/status.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;

// What a caller can read in `grpc-status-details-bin`: `FIELD: DESCRIPTION` for each violation.
std::vector<std::string> Details(const absl::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(ToGrpcStatus(status).error_details()));
  EXPECT_EQ(details.code(), static_cast<int>(status.code()));
  EXPECT_EQ(details.message(), status.message());
  std::vector<std::string> texts;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    EXPECT_TRUE(detail.UnpackTo(&request));
    for (const auto& violation : request.field_violations()) {
      texts.push_back(violation.field() + ": " + violation.description());
    }
  }
  return texts;
}

TEST(FieldViolations, AreTheDetailsOfAnError) {
  FieldViolations violations;
  violations.Add("pulses.depth", "is empty");
  violations.Add("pulses.azimuth", "has 3 bytes");
  const absl::Status status = violations.ToStatus();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "is empty");
  EXPECT_THAT(Details(status), ElementsAre("pulses.depth: is empty", "pulses.azimuth: has 3 bytes"));
}

TEST(FieldViolations, AreNoErrorWithoutAny) { EXPECT_TRUE(FieldViolations().ToStatus().ok()); }

TEST(FieldViolations, LieDeeperWithinAnotherRequest) {
  const absl::Status status = Within("query", FieldViolation("pulses.depth", "is empty"));
  EXPECT_EQ(status.message(), "is empty");
  EXPECT_THAT(Details(status), ElementsAre("query.pulses.depth: is empty"));
  EXPECT_TRUE(Within("query", absl::OkStatus()).ok());
  EXPECT_EQ(Within("query", absl::NotFoundError("no table")), absl::NotFoundError("no table"));
}

}  // namespace
}  // namespace albtpu::server
