// The bearer tokens (RFC 6750) that a server accepts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::server {

class Tokens {
 public:
  // One token a line; all are accepted, so that clients can change theirs one after the other.
  // InvalidArgument for text without a token, or with one that could be guessed or is none; the message does
  // not repeat it.
  static absl::StatusOr<Tokens> Parse(std::string_view text);

  // Whether `authorization` is `Bearer TOKEN` with one of them. How long this takes tells nothing about a
  // token but its length.
  bool Accept(std::string_view authorization) const;

 private:
  explicit Tokens(std::vector<std::string> tokens) : tokens_(std::move(tokens)) {}

  std::vector<std::string> tokens_;
};

}  // namespace albtpu::server
