#include "service/server/calls/admin_service.h"

#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
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

// The reason of a failed reload without the path of the folder, which callers must not learn.
absl::Status WithoutFolder(const absl::Status& reason, const std::filesystem::path& folder) {
  if (absl::IsInternal(reason)) return reason;  // Its message is not sent to callers.
  const std::string inside = absl::StrReplaceAll(
      reason.message(),
      {{(folder / "").string(), ""}, {absl::StrCat("'", folder.string(), "'"), "the folder of tables"}});
  return absl::FailedPreconditionError(
      absl::StrCat("tables not reloaded, the previous tables stay in use: ", inside));
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
    if (!result.ok()) {
      return finish(ToGrpcStatus(WithoutFolder(result.status(), tables_.current()->folder())));
    }
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
