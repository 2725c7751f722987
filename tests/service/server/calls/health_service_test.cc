#include "service/server/calls/health_service.h"

#include <gtest/gtest.h>

#include <chrono>

#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

class Health : public ServedTables {
 protected:
  Health() : health_(grpc::health::v1::Health::NewStub(channel_)) {}

  static HealthCheckRequest Ask(const std::string& service) {
    HealthCheckRequest request;
    request.set_service(service);
    return request;
  }

  grpc::Status Check(const std::string& service, HealthCheckResponse& response) {
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    return health_->Check(&context, Ask(service), &response);
  }

  std::unique_ptr<grpc::health::v1::Health::Stub> health_;
};

TEST_F(Health, CoversTheServerAndEachService) {
  for (const char* service : {"", "albtpu.v1.UncertaintyService", "albtpu.v1.AdminService"}) {
    HealthCheckResponse response;
    ASSERT_TRUE(Check(service, response).ok());
    EXPECT_EQ(response.status(), HealthCheckResponse::SERVING);
  }
}

TEST_F(Health, IsUnknownForOtherServices) {
  HealthCheckResponse response;
  EXPECT_EQ(Check("albtpu.v2.UncertaintyService", response).error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(Health, EndsItsWatchersWhenTheServerDrains) {
  grpc::ClientContext context, unknown_context;
  const auto watch = health_->Watch(&context, Ask(""));
  const auto unknown = health_->Watch(&unknown_context, Ask("nonsense"));
  HealthCheckResponse response;
  ASSERT_TRUE(watch->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::SERVING);
  ASSERT_TRUE(unknown->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::SERVICE_UNKNOWN);

  const auto begin = std::chrono::steady_clock::now();
  server_->Drain();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kDrainTime / 2);

  ASSERT_TRUE(watch->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::NOT_SERVING);
  EXPECT_FALSE(watch->Read(&response));
  EXPECT_TRUE(watch->Finish().ok());
}

TEST_F(Health, SurvivesWatchersThatDisconnect) {
  for (int i = 0; i < 20; ++i) {
    grpc::ClientContext context;
    const auto watch = health_->Watch(&context, Ask(""));
    HealthCheckResponse response;
    if (i % 2 == 0) {
      ASSERT_TRUE(watch->Read(&response));
    }
    context.TryCancel();
    EXPECT_EQ(watch->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  server_->Drain();
}

}  // namespace
}  // namespace albtpu::server
