#include "service/client/channel_credentials.h"

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "service/text_file.h"

namespace albtpu::client {
namespace {

// What ends the first line of a PEM file of each kind, before its hyphens.
constexpr char kCertificate[] = "CERTIFICATE", kPrivateKey[] = "PRIVATE KEY";

// Empty for no file.
absl::StatusOr<std::string> ReadPem(const std::string& flag, const std::string& path,
                                    const std::string& kind) {
  if (path.empty()) return "";
  absl::StatusOr<std::string> pem = ReadTextFile(flag, path);
  if (!pem.ok() || absl::StrContains(*pem, kind + "-----")) return pem;
  return absl::InvalidArgumentError(
      absl::StrCat(flag, ": ", path, ": a PEM file with a ", kind, " is right"));
}

absl::StatusOr<std::string> ReadToken(const std::string& path) {
  absl::StatusOr<std::string> text = ReadTextFile("--token-file", path);
  if (!text.ok()) return text;
  const absl::string_view token = absl::StripAsciiWhitespace(*text);
  const bool is_one = !token.empty() && token.find_first_of(" \t\r\n") == absl::string_view::npos;
  if (is_one) return std::string(token);
  return absl::InvalidArgumentError(
      absl::StrCat("--token-file: ", path, ": one token, and nothing else, is right"));
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeCredentials(const Credentials& credentials) {
  if (!credentials.HasTls()) return grpc::InsecureChannelCredentials();
  if (credentials.certificate.empty() != credentials.key.empty()) {
    return absl::InvalidArgumentError("--tls-cert and --tls-key: both are right, or neither");
  }
  absl::StatusOr<std::string> ca = ReadPem("--tls-ca", credentials.ca, kCertificate);
  if (!ca.ok()) return ca.status();
  absl::StatusOr<std::string> key = ReadPem("--tls-key", credentials.key, kPrivateKey);
  if (!key.ok()) return key.status();
  absl::StatusOr<std::string> certificate = ReadPem("--tls-cert", credentials.certificate, kCertificate);
  if (!certificate.ok()) return certificate.status();
  const auto tls = grpc::SslCredentials({*std::move(ca), *std::move(key), *std::move(certificate)});
  if (credentials.token.empty()) return tls;
  absl::StatusOr<std::string> token = ReadToken(credentials.token);
  if (!token.ok()) return token.status();
  return grpc::CompositeChannelCredentials(tls, grpc::AccessTokenCredentials(*token));
}

}  // namespace albtpu::client
