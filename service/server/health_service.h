// grpc.health.v1.Health. gRPC's own implementation neither lets reflection describe it nor ends the streams
// of those that watch, for which a drain would then wait in vain.
#pragma once

#include <grpcpp/grpcpp.h>

#include <mutex>
#include <set>
#include <string>

#include "grpc/health/v1/health.grpc.pb.h"

namespace albtpu::server {

// The server as a whole and the service `service_name` serve, until they stop.
class HealthService final : public grpc::health::v1::Health::CallbackService {
 public:
  explicit HealthService(std::string service_name) : service_name_(std::move(service_name)) {}

  // From now on NOT_SERVING is the answer; those that watch are told, and their streams end.
  void StopServing();

  grpc::ServerUnaryReactor* Check(grpc::CallbackServerContext* context,
                                  const grpc::health::v1::HealthCheckRequest* request,
                                  grpc::health::v1::HealthCheckResponse* response) override;
  grpc::ServerWriteReactor<grpc::health::v1::HealthCheckResponse>* Watch(
      grpc::CallbackServerContext* context, const grpc::health::v1::HealthCheckRequest* request) override;

 private:
  class Watcher;

  bool Knows(const std::string& name) const { return name.empty() || name == service_name_; }

  const std::string service_name_;
  std::mutex mutex_;
  bool serving_ = true;          // Guarded by mutex_.
  std::set<Watcher*> watchers_;  // Guarded by mutex_.
};

}  // namespace albtpu::server
