#include "service/server/access/credentials.h"

#include <grpc/grpc.h>
#include <grpc/slice.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "service/server/observe/metrics.h"
#include "service/text_file.h"
#include "status/status_macros.h"

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
    ASSIGN_OR_RETURN(const std::string text, ReadTextFile("--token-file", path));
    absl::StatusOr<Tokens> tokens = Tokens::Parse(text);
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
  static grpc_ssl_certificate_config_reload_status Fetch(void* self, grpc_ssl_server_certificate_config** config) {
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

// 128 bits in hexadecimal have 32 digits, in base64 22.
constexpr std::size_t kMinLength = 20;

constexpr absl::string_view kScheme = "bearer ";

// b64token of RFC 6750.
bool IsToken(absl::string_view text) {
  return text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=") ==
         absl::string_view::npos;
}

bool AreEqual(const std::string& token, absl::string_view text) {
  return token.size() == text.size() && CRYPTO_memcmp(token.data(), text.data(), token.size()) == 0;
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeCredentials(const CredentialFiles& files,
                                                                         const Recorders& recorders) {
  if (!files.HasTls()) return grpc::InsecureServerCredentials();
  ASSIGN_OR_RETURN(std::unique_ptr<CertificateFile> certificates,
                   OpenCertificates(files.certificates, recorders.access));
  auto credentials = std::make_shared<Tls>(std::move(certificates));
  if (files.tokens.empty()) return credentials;
  ASSIGN_OR_RETURN(std::unique_ptr<FileValue<Tokens>> tokens, OpenTokens(files.tokens));
  RequireToken(std::move(tokens), recorders, credentials->get());
  return credentials;
}

absl::StatusOr<Tokens> Tokens::Parse(std::string_view text) {
  std::vector<std::string> tokens;
  int number = 0;
  for (absl::string_view line : absl::StrSplit(absl::string_view(text.data(), text.size()), '\n')) {
    ++number;
    line = absl::StripAsciiWhitespace(line);
    if (line.empty()) continue;
    if (!IsToken(line)) {
      return absl::InvalidArgumentError(
          absl::StrCat("line ", number, " is not a token: expected letters, digits and -._~+/="));
    }
    if (line.size() < kMinLength) {
      return absl::InvalidArgumentError(absl::StrCat("line ", number, " has ", line.size(), " characters: expected ",
                                                     kMinLength, " or more, at random"));
    }
    tokens.emplace_back(line);
  }
  if (!tokens.empty()) return Tokens(std::move(tokens));
  return absl::InvalidArgumentError("holds no token: expected one per line, such as from `openssl rand -hex 32`");
}

bool Tokens::Accept(std::string_view authorization) const {
  absl::string_view text(authorization.data(), authorization.size());
  if (!absl::StartsWithIgnoreCase(text, kScheme)) return false;
  text.remove_prefix(kScheme.size());
  bool accepted = false;
  // Compares with all tokens, so that the time does not depend on which one matches.
  for (const std::string& token : tokens_) accepted |= AreEqual(token, text);
  return accepted;
}

namespace {

using TokenFile = FileValue<Tokens>;

// Methods that need no token.
constexpr std::string_view kOpen = "/grpc.health.v1.Health/";

std::string_view View(const grpc_slice& slice) {
  return {reinterpret_cast<const char*>(GRPC_SLICE_START_PTR(slice)), GRPC_SLICE_LENGTH(slice)};
}

// The value of `key`, or an empty text if there is none or more than one.
std::string_view Find(std::string_view key, const grpc_metadata* metadata, std::size_t count) {
  std::string_view value;
  int found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (View(metadata[i].key) != key) continue;
    value = View(metadata[i].value);
    ++found;
  }
  return found == 1 ? value : std::string_view();
}

struct Guard {
  std::unique_ptr<TokenFile> tokens;
  Recorders recorders;
};

// The method for the log. Callers may send any path, so only known names are logged.
std::string_view MethodOf(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const auto known = std::find(kMethodNames.begin(), kMethodNames.end(), name);
  return known == kMethodNames.end() ? "other" : *known;
}

void WriteLine(CallLog& log, const char* refusal, const grpc_metadata* metadata, std::size_t count) {
  LogFields fields = {{"method", MethodOf(Find(":path", metadata, count))}, {"code", "UNAUTHENTICATED"}};
  const std::string_view request_id = Find(RequestId::kMetadata, metadata, count);
  if (RequestId::IsValid(request_id)) fields["request_id"] = request_id;
  log.Write(spdlog::level::warn, absl::StrCat("call refused: ", refusal), std::move(fields));
}

// The reason to refuse a call, which is then counted, or nullptr if its token is valid.
const char* Refusal(const Guard& guard, const grpc_metadata* metadata, std::size_t count) {
  if (Find(":path", metadata, count).substr(0, kOpen.size()) == kOpen) return nullptr;
  const std::string_view authorization = Find("authorization", metadata, count);
  if (authorization.empty()) {
    guard.recorders.access.CountNoToken();
    return "the call has no token; send one as metadata, 'authorization: Bearer TOKEN'";
  }
  if (guard.tokens->Get()->Accept(authorization)) return nullptr;
  guard.recorders.access.CountWrongToken();
  return "the token is not accepted; ask the operator of the server for a valid one";
}

void Process(void* guard, grpc_auth_context* /*context*/, const grpc_metadata* metadata, std::size_t count,
             grpc_process_auth_metadata_done_cb done, void* call) {
  const Guard& ours = *static_cast<Guard*>(guard);
  const char* refusal = Refusal(ours, metadata, count);
  if (refusal != nullptr) WriteLine(ours.recorders.log, refusal, metadata, count);
  done(call, nullptr, 0, nullptr, 0, refusal == nullptr ? GRPC_STATUS_OK : GRPC_STATUS_UNAUTHENTICATED, refusal);
}

void Destroy(void* guard) { delete static_cast<Guard*>(guard); }

}  // namespace

void RequireToken(std::unique_ptr<TokenFile> tokens, const Recorders& recorders, grpc_server_credentials* credentials) {
  auto guard = std::make_unique<Guard>(Guard{std::move(tokens), recorders});
  grpc_server_credentials_set_auth_metadata_processor(credentials, {Process, Destroy, guard.release()});
}

}  // namespace albtpu::server
