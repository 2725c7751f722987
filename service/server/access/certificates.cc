#include "service/server/access/certificates.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <memory>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/openssl_at_exit.h"
#include "service/text_file.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

[[maybe_unused]] const bool kOpenSslIsKept = KeepOpenSslAtExit();

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Bytes = std::unique_ptr<BIO, decltype(&BIO_free)>;

Bytes OpenPem(const std::string& pem) {
  return Bytes(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free);
}

// Rejects encrypted keys: a server cannot ask for a passphrase.
int NoPassphrase(char*, int, int, void*) { return -1; }

Certificate FirstCertificate(const std::string& pem) {
  const Bytes bytes = OpenPem(pem);
  Certificate certificate(PEM_read_bio_X509(bytes.get(), nullptr, NoPassphrase, nullptr), &X509_free);
  ERR_clear_error();  // gRPC would take remaining errors for its own.
  return certificate;
}

Key FirstKey(const std::string& pem) {
  const Bytes bytes = OpenPem(pem);
  Key key(PEM_read_bio_PrivateKey(bytes.get(), nullptr, NoPassphrase, nullptr), &EVP_PKEY_free);
  ERR_clear_error();
  return key;
}

std::string Text(const ASN1_TIME* time) {
  const Bytes bytes(BIO_new(BIO_s_mem()), &BIO_free);
  ASN1_TIME_print(bytes.get(), time);
  char* text = nullptr;
  const long size = BIO_get_mem_data(bytes.get(), &text);
  return std::string(text, static_cast<std::size_t>(size));
}

std::time_t Expiry(const X509& certificate) {
  std::tm utc{};
  ASN1_TIME_to_tm(X509_get0_notAfter(&certificate), &utc);
  return timegm(&utc);
}

absl::Status CheckTimes(const std::string& where, const X509& certificate) {
  const ASN1_TIME* from = X509_get0_notBefore(&certificate);
  const ASN1_TIME* until = X509_get0_notAfter(&certificate);
  if (X509_cmp_current_time(until) < 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": the certificate expired on ", Text(until), " (no client would trust it); renew it"));
  }
  if (X509_cmp_current_time(from) > 0) {
    return absl::InvalidArgumentError(absl::StrCat(where, ": the certificate is valid only from ", Text(from),
                                                   "; wait, or set the clock of this machine"));
  }
  return absl::OkStatus();
}

// The reason why TLS rejects the pair, such as a key that is too short. Empty if TLS accepts it.
std::string Refusal(X509& certificate, EVP_PKEY& key) {
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_server_method()), &SSL_CTX_free);
  const bool accepted =
      SSL_CTX_use_certificate(context.get(), &certificate) == 1 && SSL_CTX_use_PrivateKey(context.get(), &key) == 1;
  const char* reason = accepted ? "" : ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason == nullptr ? "unknown" : reason;
}

// Checks certificate and key, and sets `pem.expiry`.
absl::Status CheckPair(const CertificateFiles& files, Certificates& pem) {
  const std::string where = absl::StrCat("--tls-cert: ", files.certificate.string());
  const Certificate certificate = FirstCertificate(pem.certificate);
  if (certificate == nullptr) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": holds no certificate: expected a PEM file, '-----BEGIN CERTIFICATE-----'"));
  }
  const Key key = FirstKey(pem.key);
  if (key == nullptr) {
    return absl::InvalidArgumentError(
        absl::StrCat("--tls-key: ", files.key.string(),
                     ": holds no key that can be read: expected a PEM file without a passphrase"));
  }
  const bool is_pair = X509_check_private_key(certificate.get(), key.get()) == 1;
  ERR_clear_error();
  if (!is_pair) {
    return absl::InvalidArgumentError(
        absl::StrCat("--tls-key: ", files.key.string(), ": is not the key of the certificate in ",
                     files.certificate.string(), ": expected the key that belongs to it"));
  }
  if (const std::string refusal = Refusal(*certificate, *key); !refusal.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": TLS refuses it (", refusal, "): expected RSA with 2048 bits or more"));
  }
  pem.expiry = Expiry(*certificate);
  return CheckTimes(where, *certificate);
}

}  // namespace

absl::StatusOr<Certificates> ReadCertificates(const CertificateFiles& files) {
  ASSIGN_OR_RETURN(std::string certificate, ReadTextFile("--tls-cert", files.certificate));
  ASSIGN_OR_RETURN(std::string key, ReadTextFile("--tls-key", files.key));
  Certificates read{std::move(certificate), std::move(key), {}, {}};
  RETURN_IF_ERROR(CheckPair(files, read));
  if (files.client_ca.empty()) return read;
  ASSIGN_OR_RETURN(std::string client_ca, ReadTextFile("--tls-client-ca", files.client_ca));
  if (FirstCertificate(client_ca) == nullptr) {
    return absl::InvalidArgumentError(absl::StrCat("--tls-client-ca: ", files.client_ca.string(),
                                                   ": holds no certificate: expected the PEM file of an authority"));
  }
  read.client_ca = std::move(client_ca);
  return read;
}

}  // namespace albtpu::server
