// How a client knows its server, and shows who it is.
#pragma once

#include <string>

namespace albtpu::client {

// Files, empty where there is none. Without any a channel is in plain text, with any it is TLS.
struct Credentials {
  std::string ca = {};           // --tls-ca, PEM: who may vouch for the server; left out, whom gRPC trusts.
  std::string certificate = {};  // --tls-cert, PEM: the certificate to show.
  std::string key = {};          // --tls-key, PEM: its key.
  std::string token = {};        // --token-file: one token, sent with every call.

  bool HasTls() const { return !(ca.empty() && certificate.empty() && key.empty() && token.empty()); }
};

}  // namespace albtpu::client
