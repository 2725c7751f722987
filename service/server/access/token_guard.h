// Lets calls with a token in, and no others.
#pragma once

#include <grpc/grpc_security.h>

#include <memory>

#include "service/server/access/tokens.h"
#include "service/server/ground/file_value.h"
#include "service/server/observe/call_record.h"

namespace albtpu::server {

// Has `credentials` refuse, before anything else is done about a call, what brings none of `tokens`: the
// caller gets UNAUTHENTICATED. Health (grpc.health.v1) is open: orchestrators ask for it, and it says nothing
// but whether the server serves. Refusals are counted and logged by `records`, which must outlive the
// credentials; without what the caller sent, and without its address, which gRPC 1.51 does not tell here.
void RequireToken(std::unique_ptr<FileValue<Tokens>> tokens, const CallRecords& records,
                  grpc_server_credentials* credentials);

}  // namespace albtpu::server
