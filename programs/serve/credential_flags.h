// --tls-cert, --tls-key, --tls-client-ca, --token-file and --insecure.
#pragma once

#include "absl/status/status.h"
#include "programs/command_line/cli_fwd.h"
#include "service/server/access/credentials.h"
#include "service/server/ground/listening_sockets.h"

namespace albtpu::programs {

struct CredentialFlags {
  server::CredentialFiles files = {};
  bool insecure = false;
};

void AddCredentialFlags(CLI::App& app, CredentialFlags& flags);

// InvalidArgument if other machines could reach `address` in plain text and --insecure is not given. The metrics are
// always in plain text.
absl::Status CheckServiceAddress(const server::ListenAddress& address, const CredentialFlags& flags);
absl::Status CheckMetricsAddress(const server::ListenAddress& address, const CredentialFlags& flags);

}  // namespace albtpu::programs
