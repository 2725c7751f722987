// The certificate of a server, and the authentication of its callers.
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <filesystem>
#include <memory>

#include "absl/status/statusor.h"
#include "service/server/access/certificates.h"
#include "service/server/observe/records.h"

namespace albtpu::server {

struct CredentialFiles {
  CertificateFiles certificates = {};
  std::filesystem::path tokens = {};  // --token-file; empty if calls need no token. Requires certificates.

  bool HasTls() const { return !certificates.certificate.empty(); }
};

// Plain text if no files are given, otherwise TLS 1.2 or 1.3. With `client_ca` a connection is refused unless its
// client shows a certificate of that authority; with `tokens` a call is refused unless it carries one (token_guard.h).
// Files that change while the server runs take effect with the next connection (certificates) or call (tokens). Fails
// if the files are invalid now. `recorders`, which record refusals and the expiry of the certificate, must outlive the
// credentials.
absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeCredentials(const CredentialFiles& files,
                                                                         const Recorders& recorders);

}  // namespace albtpu::server
