#include "service/server/ground/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/cord.h"
#include "service/server/ground/limits.h"

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
  EXPECT_EQ(ToGrpcStatus(absl::PermissionDeniedError("")).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(ToGrpcStatus(absl::CancelledError("")).error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ToGrpcStatus, KeepsTheServersOwnErrorsToItself) {
  const grpc::Status status = ToGrpcStatus(absl::DataLossError("/srv/tables/survey.h5: truncated"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_THAT(status.error_message(), ::testing::Not(::testing::HasSubstr("/srv")));
}

TEST(ToGrpcStatus, CutsWhatIsTooLongToSend) {
  // Characters of two bytes, of which the limit would halve one.
  std::string name = "x";
  while (name.size() < 2 * kMaxErrorBytes) name += "\u00e4";
  const std::string message = ToGrpcStatus(absl::NotFoundError(name)).error_message();
  EXPECT_EQ(message, name.substr(0, kMaxErrorBytes - 1) + "...");
}

TEST(ToGrpcStatus, SendsDetailsOnlyWhereThereAreAny) {
  EXPECT_EQ(ToGrpcStatus(absl::NotFoundError("no table")).error_details(), "");
  absl::Status status = absl::InvalidArgumentError("wrong");
  status.SetPayload("of our own", absl::Cord("secret"));
  EXPECT_EQ(ToGrpcStatus(status).error_details(), "");
}

}  // namespace
}  // namespace albtpu::server
