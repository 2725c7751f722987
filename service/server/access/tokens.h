// The bearer tokens (RFC 6750) that a server accepts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::server {

class Tokens {
 public:
  // One token per line. All of them are accepted, so that clients can be moved to new tokens one by one.
  // InvalidArgument if there is no token, or if a line is malformed or short enough to be guessed; the message does not
  // repeat it.
  static absl::StatusOr<Tokens> Parse(std::string_view text);

  // Whether `authorization` is `Bearer TOKEN` with one of the tokens. The time this takes reveals nothing about a token
  // but its length.
  bool Accept(std::string_view authorization) const;

 private:
  explicit Tokens(std::vector<std::string> tokens) : tokens_(std::move(tokens)) {}

  std::vector<std::string> tokens_;
};

}  // namespace albtpu::server
