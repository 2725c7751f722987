// Accepts only calls with a valid token.
#pragma once

#include <grpc/grpc_security.h>

#include <memory>

#include "service/server/access/tokens.h"
#include "service/server/ground/file_value.h"
#include "service/server/observe/records.h"

namespace albtpu::server {

// Makes `credentials` refuse calls without one of `tokens`, before anything else is done: the caller gets
// UNAUTHENTICATED. Health (grpc.health.v1) needs no token: orchestrators ask for it, and it only says whether the
// server serves. `recorders`, which must outlive the credentials, count and log refusals. The log contains neither the
// token that the caller sent nor its address, which gRPC 1.51 does not provide here.
void RequireToken(std::unique_ptr<FileValue<Tokens>> tokens, const Recorders& recorders,
                  grpc_server_credentials* credentials);

}  // namespace albtpu::server
