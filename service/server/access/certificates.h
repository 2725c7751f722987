// The certificate that a server shows, its key, and whose certificates it wants to see.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu::server {

// PEM files, as flags name them. Empty: the flag is not given.
struct CertificateFiles {
  std::filesystem::path certificate = {};  // --tls-cert: the server's, then those up to the authority.
  std::filesystem::path key = {};          // --tls-key
  std::filesystem::path client_ca = {};    // --tls-client-ca: the authorities of clients.
};

// What is in them.
struct Certificates {
  std::string certificate;
  std::string key;
  std::string client_ca;  // Empty: clients show no certificate.
  std::time_t expiry;     // Of the server's certificate.
};

// Fails unless the key is that of the certificate, which is valid now, and every file holds what it should.
// So a pair that is half replaced, or the wrong one, is never served.
absl::StatusOr<Certificates> ReadCertificates(const CertificateFiles& files);

}  // namespace albtpu::server
