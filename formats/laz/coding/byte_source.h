// A source of compressed bytes: a file, or memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "absl/status/status.h"

namespace albtpu::laz {

// Any number of threads may read at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  // Requires offset + bytes.size() <= size(). Fails when the file cannot be read.
  virtual absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const = 0;
};

// Bytes that are in memory already, and stay there.
class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
    return absl::OkStatus();
  }

 private:
  std::string_view bytes_;
};

}  // namespace albtpu::laz
