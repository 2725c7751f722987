#include "service/server/access/token_guard.h"

#include <grpc/slice.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metrics.h"

namespace albtpu::server {
namespace {

using TokenFile = FileValue<Tokens>;

// Methods that need no token.
constexpr std::string_view kOpen = "/grpc.health.v1.Health/";

std::string_view View(const grpc_slice& slice) {
  return {reinterpret_cast<const char*>(GRPC_SLICE_START_PTR(slice)), GRPC_SLICE_LENGTH(slice)};
}

// The value of `key`, or an empty text if there is none or more than one.
std::string_view Find(std::string_view key, const grpc_metadata* metadata, std::size_t count) {
  std::string_view value;
  int found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (View(metadata[i].key) != key) continue;
    value = View(metadata[i].value);
    ++found;
  }
  return found == 1 ? value : std::string_view();
}

struct Guard {
  std::unique_ptr<TokenFile> tokens;
  Recorders recorders;
};

// The method for the log. Callers may send any path, so only known names are logged.
std::string_view MethodOf(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const auto known = std::find(kMethodNames.begin(), kMethodNames.end(), name);
  return known == kMethodNames.end() ? "other" : *known;
}

void WriteLine(CallLog& log, const char* refusal, const grpc_metadata* metadata, std::size_t count) {
  LogFields fields = {{"method", MethodOf(Find(":path", metadata, count))}, {"code", "UNAUTHENTICATED"}};
  const std::string_view request_id = Find(RequestId::kMetadata, metadata, count);
  if (RequestId::IsValid(request_id)) fields["request_id"] = request_id;
  log.Write(spdlog::level::warn, absl::StrCat("call refused: ", refusal), std::move(fields));
}

// The reason to refuse a call, which is then counted, or nullptr if its token is valid.
const char* Refusal(const Guard& guard, const grpc_metadata* metadata, std::size_t count) {
  if (Find(":path", metadata, count).substr(0, kOpen.size()) == kOpen) return nullptr;
  const std::string_view authorization = Find("authorization", metadata, count);
  if (authorization.empty()) {
    guard.recorders.access.CountNoToken();
    return "the call has no token; send one as metadata, 'authorization: Bearer TOKEN'";
  }
  if (guard.tokens->Get()->Accept(authorization)) return nullptr;
  guard.recorders.access.CountWrongToken();
  return "the token is not accepted; ask the operator of the server for a valid one";
}

void Process(void* guard, grpc_auth_context* /*context*/, const grpc_metadata* metadata, std::size_t count,
             grpc_process_auth_metadata_done_cb done, void* call) {
  const Guard& ours = *static_cast<Guard*>(guard);
  const char* refusal = Refusal(ours, metadata, count);
  if (refusal != nullptr) WriteLine(ours.recorders.log, refusal, metadata, count);
  done(call, nullptr, 0, nullptr, 0, refusal == nullptr ? GRPC_STATUS_OK : GRPC_STATUS_UNAUTHENTICATED,
       refusal);
}

void Destroy(void* guard) { delete static_cast<Guard*>(guard); }

}  // namespace

void RequireToken(std::unique_ptr<TokenFile> tokens, const Recorders& recorders,
                  grpc_server_credentials* credentials) {
  auto guard = std::make_unique<Guard>(Guard{std::move(tokens), recorders});
  grpc_server_credentials_set_auth_metadata_processor(credentials, {Process, Destroy, guard.release()});
}

}  // namespace albtpu::server
