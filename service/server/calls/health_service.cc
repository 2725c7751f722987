#include "service/server/calls/health_service.h"

namespace albtpu::server {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

namespace {

HealthCheckResponse::ServingStatus ToStatus(bool serving) {
  return serving ? HealthCheckResponse::SERVING : HealthCheckResponse::NOT_SERVING;
}

}  // namespace

// One stream of Watch: the status now, and NOT_SERVING at the end. gRPC allows one write at a time and one end.
class HealthService::Watcher final : public grpc::ServerWriteReactor<HealthCheckResponse> {
 public:
  Watcher(HealthService& service, bool known) : service_(service), known_(known) {
    const std::lock_guard lock(service_.mutex_);
    service_.watchers_.insert(this);
    if (service_.serving_) {
      Begin();
    } else {
      End();
    }
  }

  // Call this, Begin() and End() with the mutex held.
  void Stop() {
    if (!writing_) End();
  }

 private:
  void Begin() {
    writing_ = true;
    response_.set_status(known_ ? ToStatus(true) : HealthCheckResponse::SERVICE_UNKNOWN);
    StartWrite(&response_);
  }

  void End() {
    if (ended_) return;
    ended_ = true;
    response_.set_status(known_ ? ToStatus(false) : HealthCheckResponse::SERVICE_UNKNOWN);
    StartWriteAndFinish(&response_, grpc::WriteOptions(), grpc::Status::OK);
  }

  void OnWriteDone(bool /*ok*/) override {
    const std::lock_guard lock(service_.mutex_);
    writing_ = false;
    if (!service_.serving_) End();
  }

  void OnCancel() override {
    const std::lock_guard lock(service_.mutex_);
    if (ended_) return;
    ended_ = true;
    Finish(grpc::Status::CANCELLED);
  }

  void OnDone() override {
    {
      const std::lock_guard lock(service_.mutex_);
      service_.watchers_.erase(this);
    }
    delete this;
  }

  HealthService& service_;
  const bool known_;
  HealthCheckResponse response_;
  bool writing_ = false;
  bool ended_ = false;
};

void HealthService::StopServing() {
  const std::lock_guard lock(mutex_);
  serving_ = false;
  for (Watcher* watcher : watchers_) watcher->Stop();
}

grpc::ServerUnaryReactor* HealthService::Check(grpc::CallbackServerContext* context,
                                               const HealthCheckRequest* request,
                                               HealthCheckResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (!Knows(request->service())) {
    reactor->Finish(grpc::Status(grpc::StatusCode::NOT_FOUND, "the server has no such service"));
    return reactor;
  }
  const std::lock_guard lock(mutex_);
  response->set_status(ToStatus(serving_));
  reactor->Finish(grpc::Status::OK);
  return reactor;
}

grpc::ServerWriteReactor<HealthCheckResponse>* HealthService::Watch(grpc::CallbackServerContext* /*context*/,
                                                                    const HealthCheckRequest* request) {
  return new Watcher(*this, Knows(request->service()));
}

}  // namespace albtpu::server
