#include "formats/files/output_file.h"

#include <sys/stat.h>

#include <system_error>

#include "absl/strings/str_cat.h"

namespace albtpu::formats {
FileStamp FileStamp::Of(int descriptor) {
  FileStamp stamp;
  struct stat status;
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return stamp;
  stamp.is_regular_ = true;
  stamp.size_ = static_cast<std::uint64_t>(status.st_size);
  stamp.modified_ = status.st_mtim;
  return stamp;
}

absl::Status FileStamp::CheckUnchanged(const std::string& name, int descriptor) const {
  const FileStamp now = Of(descriptor);
  if (now.size_ == size_ && now.modified_.tv_sec == modified_.tv_sec && now.modified_.tv_nsec == modified_.tv_nsec)
    return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(name, ": changed while it was read (", size_, " bytes, then ", now.size_,
                   "), so nothing was written; run again when no program writes to it"));
}

absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored))
    return absl::FailedPreconditionError(absl::StrCat(output.string(), ": is the input itself; write to another file"));
  return absl::OkStatus();
}

}  // namespace albtpu::formats
