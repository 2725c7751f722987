// grpc.health.v1.Health. The implementation in gRPC cannot be described by reflection, and it does not end the streams
// of watchers, for which a drain would wait in vain.
#pragma once

#include <grpcpp/grpcpp.h>

#include <mutex>
#include <set>
#include <string>

#include "grpc/health/v1/health.grpc.pb.h"

namespace albtpu::server {

// Reports the server as a whole, and each of its services, as SERVING until StopServing().
class HealthService final : public grpc::health::v1::Health::CallbackService {
 public:
  explicit HealthService(std::set<std::string> services) : services_(std::move(services)) {}

  // Reports NOT_SERVING from now on, notifies the watchers and ends their streams.
  void StopServing();

  grpc::ServerUnaryReactor* Check(grpc::CallbackServerContext* context,
                                  const grpc::health::v1::HealthCheckRequest* request,
                                  grpc::health::v1::HealthCheckResponse* response) override;
  grpc::ServerWriteReactor<grpc::health::v1::HealthCheckResponse>* Watch(
      grpc::CallbackServerContext* context, const grpc::health::v1::HealthCheckRequest* request) override;

 private:
  class Watcher;

  bool Knows(const std::string& name) const { return name.empty() || services_.count(name) > 0; }

  const std::set<std::string> services_;
  std::mutex mutex_;
  bool serving_ = true;          // Guarded by mutex_.
  std::set<Watcher*> watchers_;  // Guarded by mutex_.
};

}  // namespace albtpu::server
