#include "service/server/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace albtpu::server {
namespace {

TEST(ToGrpcStatus, PassesOnWhatTheCallerCanMend) {
  EXPECT_TRUE(ToGrpcStatus(absl::OkStatus()).ok());
  const grpc::Status status = ToGrpcStatus(absl::InvalidArgumentError("send at least one"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "send at least one");
  EXPECT_EQ(ToGrpcStatus(absl::NotFoundError("")).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(ToGrpcStatus(absl::FailedPreconditionError("")).error_code(),
            grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(ToGrpcStatus(absl::CancelledError("")).error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ToGrpcStatus, KeepsTheServersOwnErrorsToItself) {
  const grpc::Status status = ToGrpcStatus(absl::DataLossError("/srv/tables/survey.h5: truncated"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_THAT(status.error_message(), ::testing::Not(::testing::HasSubstr("/srv")));
}

}  // namespace
}  // namespace albtpu::server
