// The files by which a client verifies its server and identifies itself.
#pragma once

#include <string>

namespace albtpu::client {

// File names; empty where there is no file. Without any file the channel is plain text, with any of them it uses TLS.
struct Credentials {
  std::string ca = {};           // --tls-ca, PEM: authorities that may sign the server's certificate.
                                 // Empty: the authorities that gRPC trusts.
  std::string certificate = {};  // --tls-cert, PEM: the client's certificate.
  std::string key = {};          // --tls-key, PEM: the key of that certificate.
  std::string token = {};        // --token-file: a single token, sent with every call.

  bool HasTls() const { return !(ca.empty() && certificate.empty() && key.empty() && token.empty()); }
};

}  // namespace albtpu::client
