// Detects that an input file was modified while it was read.
#pragma once

#include <cstdint>
#include <ctime>
#include <string>

#include "absl/status/status.h"

namespace albtpu::formats {

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

}  // namespace albtpu::formats
