// SHA-256, the digest of a file (seal.h) and of the content of a table (table.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace albtpu {

using Sha256Digest = std::array<std::uint8_t, 32>;

// The digest of all bytes passed to Update, in their order.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void Update(const void* bytes, std::size_t count);
  void Update(std::string_view text) { Update(text.data(), text.size()); }

  // Must be called once, after all calls of Update.
  Sha256Digest Finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// 64 lowercase hexadecimal digits.
std::string Hex(const Sha256Digest& digest);

}  // namespace albtpu
