#include "service/server/ground/errors.h"

#include <gmock/gmock.h>

#include "absl/strings/cord.h"
#include "google/rpc/status.pb.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;

// The violations in `grpc-status-details-bin`, each as `FIELD: DESCRIPTION`.
std::vector<std::string> Details(const absl::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(ToGrpcStatus(status).error_details()));
  EXPECT_EQ(details.code(), static_cast<int>(status.code()));
  EXPECT_EQ(details.message(), status.message());
  std::vector<std::string> texts;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    EXPECT_TRUE(detail.UnpackTo(&request));
    for (const auto& violation : request.field_violations())
      texts.push_back(violation.field() + ": " + violation.description());
  }
  return texts;
}

TEST(FieldViolations, BecomeTheDetailsOfAnError) {
  FieldViolations violations;
  violations.Add("pulses.depth", "is empty");
  violations.Add("pulses.azimuth", "has 3 bytes");
  const absl::Status status = violations.ToStatus();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "is empty");
  EXPECT_THAT(Details(status), ElementsAre("pulses.depth: is empty", "pulses.azimuth: has 3 bytes"));
}

TEST(FieldViolations, AreOkIfEmpty) { EXPECT_TRUE(FieldViolations().ToStatus().ok()); }

TEST(FieldViolations, GetAPrefixWithinAnotherRequest) {
  const absl::Status status = Within("query", FieldViolation("pulses.depth", "is empty"));
  EXPECT_EQ(status.message(), "is empty");
  EXPECT_THAT(Details(status), ElementsAre("query.pulses.depth: is empty"));
  EXPECT_TRUE(Within("query", absl::OkStatus()).ok());
  EXPECT_EQ(Within("query", absl::NotFoundError("no table")), absl::NotFoundError("no table"));
}

TEST(ToGrpcStatus, PassesOnErrorsThatTheCallerCanCorrect) {
  EXPECT_TRUE(ToGrpcStatus(absl::OkStatus()).ok());
  const grpc::Status status = ToGrpcStatus(absl::InvalidArgumentError("send at least one"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "send at least one");
  EXPECT_EQ(ToGrpcStatus(absl::NotFoundError("")).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(ToGrpcStatus(absl::FailedPreconditionError("")).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(ToGrpcStatus(absl::PermissionDeniedError("")).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(ToGrpcStatus(absl::CancelledError("")).error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ToGrpcStatus, HidesInternalErrors) {
  const grpc::Status status = ToGrpcStatus(absl::DataLossError("/srv/tables/survey.h5: truncated"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_THAT(status.error_message(), ::testing::Not(::testing::HasSubstr("/srv")));
}

TEST(ToGrpcStatus, CutsLongMessagesBetweenCharacters) {
  // Characters of two bytes; the limit falls within one of them.
  std::string name = "x";
  while (name.size() < 2 * kMaxErrorBytes) name += "\u00e4";
  const std::string message = ToGrpcStatus(absl::NotFoundError(name)).error_message();
  EXPECT_EQ(message, name.substr(0, kMaxErrorBytes - 1) + "...");
}

TEST(ToGrpcStatus, SendsDetailsOnlyIfThereAreAny) {
  EXPECT_EQ(ToGrpcStatus(absl::NotFoundError("no table")).error_details(), "");
  absl::Status status = absl::InvalidArgumentError("wrong");
  status.SetPayload("our own type", absl::Cord("secret"));
  EXPECT_EQ(ToGrpcStatus(status).error_details(), "");
}

}  // namespace
}  // namespace albtpu::server
