#include "service/server/access/credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "service/server/access/token_guard.h"
#include "service/server/access/tokens.h"
#include "service/server/ground/file_value.h"
#include "service/text_file.h"

namespace albtpu::server {
namespace {

using CertificateFile = FileValue<Certificates>;

absl::StatusOr<std::unique_ptr<CertificateFile>> OpenCertificates(const CertificateFiles& files,
                                                                  AccessMetrics& metrics) {
  std::vector<std::filesystem::path> watched = {files.certificate, files.key};
  if (!files.client_ca.empty()) watched.push_back(files.client_ca);
  return CertificateFile::Open(std::move(watched), [files, &metrics] {
    absl::StatusOr<Certificates> read = ReadCertificates(files);
    if (read.ok()) metrics.SetCertificateExpiry(read->expiry);
    return read;
  });
}

absl::StatusOr<std::unique_ptr<FileValue<Tokens>>> OpenTokens(const std::filesystem::path& path) {
  return FileValue<Tokens>::Open({path}, [path]() -> absl::StatusOr<Tokens> {
    const absl::StatusOr<std::string> text = ReadTextFile("--token-file", path);
    if (!text.ok()) return text.status();
    absl::StatusOr<Tokens> tokens = Tokens::Parse(*text);
    if (tokens.ok()) return tokens;
    return absl::Status(tokens.status().code(),
                        absl::StrCat("--token-file: ", path.string(), ": ", tokens.status().message()));
  });
}

// gRPC fetches the certificates before each handshake. Its own file watcher (FileWatcherCertificateProvider in 1.51)
// would replace a valid pair by a mismatched one while first the key and then its certificate is replaced.
class Tls final : public grpc::ServerCredentials {
 public:
  explicit Tls(std::unique_ptr<CertificateFile> certificates)
      : certificates_(std::move(certificates)),
        credentials_(grpc_ssl_server_credentials_create_with_options(
                         grpc_ssl_server_credentials_create_options_using_config_fetcher(
                             certificates_->Get()->client_ca.empty()
                                 ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                                 : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY,
                             Fetch, this)),
                     &grpc_server_credentials_release) {}

  grpc_server_credentials* get() { return credentials_.get(); }

  // Not used: RequireToken() checks tokens.
  void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>&) override {}

 private:
  int AddPortToServer(const std::string& address, grpc_server* server) override {
    return grpc_server_add_http2_port(server, address.c_str(), credentials_.get());
  }

  // Called by one thread at a time.
  static grpc_ssl_certificate_config_reload_status Fetch(void* self,
                                                         grpc_ssl_server_certificate_config** config) {
    return static_cast<Tls*>(self)->Fetch(*config);
  }

  grpc_ssl_certificate_config_reload_status Fetch(grpc_ssl_server_certificate_config*& config) {
    std::shared_ptr<const Certificates> now = certificates_->Get();
    if (now == fetched_) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
    const grpc_ssl_pem_key_cert_pair pair = {now->key.c_str(), now->certificate.c_str()};
    // gRPC 1.51 requires authorities even if clients show no certificate.
    const std::string& authorities = now->client_ca.empty() ? now->certificate : now->client_ca;
    config = grpc_ssl_server_certificate_config_create(authorities.c_str(), &pair, 1);
    fetched_ = std::move(now);
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
  }

  std::unique_ptr<CertificateFile> certificates_;
  std::shared_ptr<const Certificates> fetched_;
  std::unique_ptr<grpc_server_credentials, decltype(&grpc_server_credentials_release)> credentials_;
};

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeCredentials(const CredentialFiles& files,
                                                                         const Recorders& recorders) {
  if (!files.HasTls()) return grpc::InsecureServerCredentials();
  absl::StatusOr<std::unique_ptr<CertificateFile>> certificates =
      OpenCertificates(files.certificates, recorders.access);
  if (!certificates.ok()) return certificates.status();
  auto credentials = std::make_shared<Tls>(*std::move(certificates));
  if (files.tokens.empty()) return credentials;
  absl::StatusOr<std::unique_ptr<FileValue<Tokens>>> tokens = OpenTokens(files.tokens);
  if (!tokens.ok()) return tokens.status();
  RequireToken(*std::move(tokens), recorders, credentials->get());
  return credentials;
}

}  // namespace albtpu::server
