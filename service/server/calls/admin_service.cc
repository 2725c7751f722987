#include "service/server/calls/admin_service.h"

#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "service/server/ground/status.h"

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

// Why a reload was refused, in the names of the folder: where that lies is not for callers to know.
absl::Status WithoutFolder(const absl::Status& reason, const std::filesystem::path& folder) {
  if (absl::IsInternal(reason)) return reason;  // Nothing of which is told to callers.
  const std::string inside = absl::StrReplaceAll(
      reason.message(),
      {{(folder / "").string(), ""}, {absl::StrCat("'", folder.string(), "'"), "the folder of tables"}});
  return absl::FailedPreconditionError(
      absl::StrCat("nothing has changed, the tables from before still answer: ", inside));
}

}  // namespace

bool IsOfThisMachine(std::string_view peer) {
  const absl::string_view text(peer.data(), peer.size());
  return absl::StartsWith(text, "ipv4:127.") || absl::StartsWith(text, "ipv6:%5B::1%5D:") ||
         absl::StartsWith(text, "ipv6:[::1]:") || absl::StartsWith(text, "unix:");
}

grpc::ServerUnaryReactor* AdminService::ReloadTables(grpc::CallbackServerContext* context,
                                                     const v1::ReloadTablesRequest* /*request*/,
                                                     v1::ReloadTablesResponse* response) {
  CallRecord record(records_, Method::kReloadTables, *context);
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const auto finish = [reactor, record](const grpc::Status& status) {
    record.End(status);
    reactor->Finish(status);
  };
  if (callers_ == AdminCallers::kOfThisMachine && !IsOfThisMachine(context->peer())) {
    finish(ToGrpcStatus(absl::PermissionDeniedError(
        "tables are reloaded for callers on the machine of the server alone: call from there, or send "
        "SIGHUP")));
    return reactor;
  }
  tables_.Reload([this, response, finish](const LiveTables::Outcome& outcome) {
    if (!outcome.ok()) {
      return finish(ToGrpcStatus(WithoutFolder(outcome.status(), tables_.current()->folder())));
    }
    for (const TableCatalog::Change& change : *outcome) {
      v1::ReloadedTable& table = *response->add_tables();
      table.set_name(change.name);
      table.set_change(ToWire(change.kind));
    }
    finish(grpc::Status::OK);
  });
  return reactor;
}

}  // namespace albtpu::server
