#include "annotate/run/file_progress.h"

#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "service/client/channel.h"

namespace albtpu::annotate {
namespace {

grpc::Status Refusal(const std::string& details) {
  return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "depth is empty", details);
}

TEST(MessageWithDetails, AddsTheFieldsThatTheMessageDoesNotMention) {
  google::rpc::BadRequest request;
  for (const auto& [field, what] : {std::pair("depth", "depth is empty"), {"azimuth", "has 3 bytes"}}) {
    request.add_field_violations()->set_field(field);
    request.mutable_field_violations()->rbegin()->set_description(what);
  }
  google::rpc::Status details;
  details.add_details()->PackFrom(request);
  const absl::Status status = client::FromGrpc(Refusal(details.SerializeAsString()));
  EXPECT_EQ(MessageWithDetails(status), "depth is empty; azimuth: has 3 bytes");
  EXPECT_EQ(MessageWithDetails(client::WithMessage(status, "server there: depth is empty")),
            "server there: depth is empty; azimuth: has 3 bytes");
}

TEST(MessageWithDetails, IsTheMessageWhenThereAreNoDetails) {
  EXPECT_EQ(MessageWithDetails(client::FromGrpc(Refusal(""))), "depth is empty");
  EXPECT_EQ(MessageWithDetails(client::FromGrpc(Refusal("no message"))), "depth is empty");
  EXPECT_EQ(MessageWithDetails(absl::NotFoundError("no file")), "no file");
}

TEST(RateText, HasNoExponent) {
  EXPECT_EQ(RateText(6'240'000, 2, "points"), "3.12 million points/s");
  EXPECT_EQ(RateText(36'600, 2, "points"), "18300 points/s");
  EXPECT_EQ(RateText(7, 2, "pulses"), "3.5 pulses/s");
}

}  // namespace
}  // namespace albtpu::annotate
