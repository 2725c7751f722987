// How a server proves who it is, and who may call it.
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <filesystem>
#include <memory>

#include "absl/status/statusor.h"
#include "service/server/access/certificates.h"
#include "service/server/observe/call_record.h"

namespace albtpu::server {

struct CredentialFiles {
  CertificateFiles certificates = {};
  std::filesystem::path tokens = {};  // --token-file; empty: none is asked for. Wants certificates.

  bool HasTls() const { return !certificates.certificate.empty(); }
};

// Plain text without files. Else TLS 1.2 or 1.3; with `client_ca` a connection is refused unless its client
// shows a certificate of that authority; with `tokens` a call is refused unless it brings one
// (token_guard.h). Files that change while the server runs hold from the next connection (certificates) or
// call (tokens) on; fails where they are not right now. `records`, of those who are not let in and of the
// certificate, must outlive the credentials.
absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeCredentials(const CredentialFiles& files,
                                                                         const CallRecords& records);

}  // namespace albtpu::server
