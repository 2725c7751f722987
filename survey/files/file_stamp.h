// Whether a file stayed what it was while it was read.
#pragma once

#include <cstdint>
#include <ctime>
#include <string>

#include "absl/status/status.h"

namespace albtpu::client {

// Size and time of the last change of an open file. Pipes and devices have neither, and never change.
class FileStamp {
 public:
  static FileStamp Of(int descriptor);

  std::uint64_t size() const { return size_; }
  bool is_regular() const { return is_regular_; }

  // FailedPrecondition when the open file is no longer what it was.
  absl::Status CheckUnchanged(const std::string& name, int descriptor) const;

 private:
  bool is_regular_ = false;
  std::uint64_t size_ = 0;
  std::timespec modified_ = {};
};

}  // namespace albtpu::client
