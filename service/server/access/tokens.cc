#include "service/server/access/tokens.h"

#include <openssl/crypto.h>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace albtpu::server {
namespace {

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
      return absl::InvalidArgumentError(absl::StrCat("line ", number, " has ", line.size(),
                                                     " characters: expected ", kMinLength,
                                                     " or more, at random"));
    }
    tokens.emplace_back(line);
  }
  if (!tokens.empty()) return Tokens(std::move(tokens));
  return absl::InvalidArgumentError(
      "holds no token: expected one per line, such as from `openssl rand -hex 32`");
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

}  // namespace albtpu::server
