// A whole regular file as read-only memory, or memory in the place of one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "absl/status/statusor.h"

namespace albtpu::formats {

class MappedFile {
 public:
  // `what` names what the file should be, for messages, such as "an SBET". An empty file has no bytes.
  static absl::StatusOr<MappedFile> Open(const std::filesystem::path& path, std::string_view what);

  // Bytes that must outlive it.
  static MappedFile View(std::string_view bytes) { return MappedFile(bytes.data(), bytes.size(), false); }

  MappedFile(MappedFile&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        mapped_(std::exchange(other.mapped_, false)) {}
  MappedFile& operator=(MappedFile&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
  }
  ~MappedFile();

  std::string_view bytes() const { return {data_, size_}; }

 private:
  MappedFile(const char* data, std::size_t size, bool mapped) : data_(data), size_(size), mapped_(mapped) {}

  const char* data_ = nullptr;
  std::size_t size_ = 0;
  bool mapped_ = false;
};

}  // namespace albtpu::formats
