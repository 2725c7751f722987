// --tls-cert, --tls-key, --tls-client-ca, --token-file and --insecure.
#pragma once

#include <CLI/CLI.hpp>

#include "absl/status/status.h"
#include "service/server/access/credentials.h"
#include "service/server/ground/listen_address.h"

namespace albtpu::server {

struct CredentialFlags {
  CredentialFiles files = {};
  bool insecure = false;
};

void AddCredentialFlags(CLI::App& app, CredentialFlags& flags);

// InvalidArgument where other machines could reach `address` in plain text, and nobody said --insecure.
// Metrics are in plain text always.
absl::Status CheckReach(const ListenAddress& address, const CredentialFlags& flags);
absl::Status CheckReachOfMetrics(const ListenAddress& address, const CredentialFlags& flags);

}  // namespace albtpu::server
