// The certificate of a server, and the authentication of its callers by certificates and tokens.
#pragma once

#include <grpc/grpc_security.h>
#include <grpcpp/security/server_credentials.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/access/certificates.h"
#include "service/server/ground/file_value.h"
#include "service/server/observe/log.h"

namespace albtpu::server {

struct CredentialFiles {
  CertificateFiles certificates = {};
  std::filesystem::path tokens = {};  // --token-file; empty if calls need no token. Requires certificates.

  bool HasTls() const { return !certificates.certificate.empty(); }
};

// Plain text if no files are given, otherwise TLS 1.2 or 1.3. With `client_ca` a connection is refused unless its
// client shows a certificate of that authority; with `tokens` a call is refused unless it carries one (RequireToken).
// Files that change while the server runs take effect with the next connection (certificates) or call (tokens). Fails
// if the files are invalid now. `recorders`, which record refusals and the expiry of the certificate, must outlive the
// credentials.
absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeCredentials(const CredentialFiles& files,
                                                                         const Recorders& recorders);

// The bearer tokens (RFC 6750) that a server accepts.

class Tokens {
 public:
  // One token per line. All of them are accepted, so that clients can be moved to new tokens one by one.
  // InvalidArgument if there is no token, or if a line is malformed or short enough to be guessed; the message does not
  // repeat it.
  static absl::StatusOr<Tokens> Parse(std::string_view text);

  // Whether `authorization` is `Bearer TOKEN` with one of the tokens. The time this takes reveals nothing about a token
  // but its length.
  bool Accept(std::string_view authorization) const;

 private:
  explicit Tokens(std::vector<std::string> tokens) : tokens_(std::move(tokens)) {}

  std::vector<std::string> tokens_;
};

// Accepts only calls with a valid token.

// Makes `credentials` refuse calls without one of `tokens`, before anything else is done: the caller gets
// UNAUTHENTICATED. Health (grpc.health.v1) needs no token: orchestrators ask for it, and it only says whether the
// server serves. `recorders`, which must outlive the credentials, count and log refusals. The log contains neither the
// token that the caller sent nor its address, which gRPC 1.51 does not provide here.
void RequireToken(std::unique_ptr<FileValue<Tokens>> tokens, const Recorders& recorders,
                  grpc_server_credentials* credentials);

}  // namespace albtpu::server
