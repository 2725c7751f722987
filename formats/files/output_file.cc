#include "formats/files/output_file.h"

#include <system_error>

#include "absl/strings/str_cat.h"

namespace albtpu::formats {

absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored)) {
    return absl::FailedPreconditionError(
        absl::StrCat(output.string(), ": is the input itself; write to another file"));
  }
  return absl::OkStatus();
}

}  // namespace albtpu::formats
