#include "service/server/calls/health_service.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "service/server/ground/errors.h"

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
    if (service_.serving_)
      Begin();
    else
      End();
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

grpc::ServerUnaryReactor* HealthService::Check(grpc::CallbackServerContext* context, const HealthCheckRequest* request,
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

namespace {

v1::TableChange ToWire(TableCatalog::Change::Kind kind) {
  switch (kind) {
    case TableCatalog::Change::Kind::kLoaded:
      return v1::TABLE_CHANGE_LOADED;
    case TableCatalog::Change::Kind::kKept:
      return v1::TABLE_CHANGE_KEPT;
    case TableCatalog::Change::Kind::kRemoved:
      return v1::TABLE_CHANGE_REMOVED;
  }
  return v1::TABLE_CHANGE_UNSPECIFIED;
}

// The reason of a failed reload without the paths of the tables, which callers must not learn.
absl::Status WithoutPaths(const absl::Status& reason, const TableCatalog& tables) {
  if (absl::IsInternal(reason)) return reason;  // Its message is not sent to callers.
  const std::filesystem::path& folder = tables.folder();
  std::string message = absl::StrReplaceAll(
      reason.message(),
      {{(folder / "").string(), ""}, {absl::StrCat("'", folder.string(), "'"), "the folder of tables"}});
  if (tables.water() != nullptr) {
    const std::filesystem::path& water = tables.water()->path;
    absl::StrReplaceAll({{water.string(), water.filename().string()}}, &message);
  }
  return absl::FailedPreconditionError(absl::StrCat("tables not reloaded, the previous tables stay in use: ", message));
}

}  // namespace

bool IsLocalPeer(std::string_view peer) {
  const absl::string_view text(peer.data(), peer.size());
  return absl::StartsWith(text, "ipv4:127.") || absl::StartsWith(text, "ipv6:%5B::1%5D:") ||
         absl::StartsWith(text, "ipv6:[::1]:") || absl::StartsWith(text, "unix:");
}

grpc::ServerUnaryReactor* AdminService::ReloadTables(grpc::CallbackServerContext* context,
                                                     const v1::ReloadTablesRequest* /*request*/,
                                                     v1::ReloadTablesResponse* response) {
  CallRecord record(recorders_, Method::kReloadTables, *context);
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const auto finish = [reactor, record](const grpc::Status& status) {
    record.End(status);
    reactor->Finish(status);
  };
  if (callers_ == AdminCallers::kLocal && !IsLocalPeer(context->peer())) {
    finish(ToGrpcStatus(absl::PermissionDeniedError(
        "only callers on the machine of the server may reload tables; call from there, or send SIGHUP to "
        "the server")));
    return reactor;
  }
  tables_.Reload([this, response, finish](const LiveTables::ReloadResult& result) {
    if (!result.ok()) return finish(ToGrpcStatus(WithoutPaths(result.status(), *tables_.current())));
    for (const TableCatalog::Change& change : *result) {
      v1::ReloadedTable& table = *response->add_tables();
      table.set_name(change.name);
      table.set_change(ToWire(change.kind));
    }
    finish(grpc::Status::OK);
  });
  return reactor;
}

}  // namespace albtpu::server
