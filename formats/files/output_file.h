// The output of a command: a file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>

#include "absl/status/status.h"
#include "tables/file/atomic_file.h"

namespace albtpu::formats {

// Detects that an input file was modified while it was read.

// Size and modification time of an open file. Pipes and devices have neither, and count as unchanged.
class FileStamp {
 public:
  static FileStamp Of(int descriptor);

  std::uint64_t size() const { return size_; }
  bool is_regular() const { return is_regular_; }

  // FailedPrecondition when the open file has been modified since the stamp was taken.
  absl::Status CheckUnchanged(const std::string& name, int descriptor) const;

 private:
  bool is_regular_ = false;
  std::uint64_t size_ = 0;
  std::timespec modified_ = {};
};

// FailedPrecondition when `output` and `input` are the same file, under whatever names: the input would be replaced
// while it is read.
absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace albtpu::formats
