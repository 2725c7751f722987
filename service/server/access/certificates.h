// The certificate and key of a server, and the authorities that it trusts for certificates of clients.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>

#include "absl/status/statusor.h"

namespace albtpu::server {

// PEM files, as given by flags. A path is empty if its flag is not given.
struct CertificateFiles {
  std::filesystem::path certificate = {};  // --tls-cert: the server's, then intermediate certificates.
  std::filesystem::path key = {};          // --tls-key
  std::filesystem::path client_ca = {};    // --tls-client-ca: the authorities of client certificates.
};

// The content of these files.
struct Certificates {
  std::string certificate;
  std::string key;
  std::string client_ca;  // Empty if clients need no certificate.
  std::time_t expiry;     // Of the server's certificate.
};

// Fails unless every file has the expected content, the certificate is valid now, and the key belongs to it. A pair of
// which only one file has been replaced is therefore never used.
absl::StatusOr<Certificates> ReadCertificates(const CertificateFiles& files);

}  // namespace albtpu::server
