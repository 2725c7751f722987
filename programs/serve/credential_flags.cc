#include "programs/serve/credential_flags.h"

#include <CLI/CLI.hpp>

#include "absl/strings/str_cat.h"
#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

absl::Status CheckPlainText(const char* flag, const server::ListenAddress& address, const CredentialFlags& flags,
                            const char* remedy) {
  if (address.IsLoopback() || flags.insecure) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(flag, ": ", address.ToString(),
                                                 " can be reached from other machines in plain text; ", remedy,
                                                 "listen on 127.0.0.1, or give --insecure"));
}

}  // namespace

void AddCredentialFlags(CLI::App& app, CredentialFlags& flags) {
  server::CertificateFiles& certificates = flags.files.certificates;
  const auto add_file = [&app](const char* flag, std::filesystem::path& path, const char* description) {
    return app.add_option(flag, path, description)->type_name("FILE")->check(NotEmpty("file"));
  };
  CLI::Option* certificate =
      add_file("--tls-cert", certificates.certificate,
               "Use TLS with this certificate and its intermediate certificates (PEM); read again when it changes");
  CLI::Option* key = add_file("--tls-key", certificates.key, "Key of the certificate (PEM, no passphrase)");
  certificate->needs(key);
  key->needs(certificate);
  add_file("--tls-client-ca", certificates.client_ca, "Refuse clients without a certificate of these authorities (PEM)")
      ->needs(certificate);
  add_file("--token-file", flags.files.tokens, "Refuse calls without one of these tokens, one per line")
      ->needs(certificate);
  app.add_flag("--insecure", flags.insecure,
               "Allow plain text beyond this machine, for the service without TLS and for --metrics");
  Group(app, "Access to the server", {"--tls-cert", "--tls-key", "--tls-client-ca", "--token-file", "--insecure"});
}

absl::Status CheckServiceAddress(const server::ListenAddress& address, const CredentialFlags& flags) {
  if (flags.files.HasTls()) return absl::OkStatus();
  return CheckPlainText("--listen", address, flags, "give --tls-cert and --tls-key, ");
}

absl::Status CheckMetricsAddress(const server::ListenAddress& address, const CredentialFlags& flags) {
  return CheckPlainText("--metrics", address, flags, "");
}

}  // namespace albtpu::programs
