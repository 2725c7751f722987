#include "formats/files/file_access.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "absl/strings/str_cat.h"

namespace albtpu::formats {
namespace {

absl::Status SystemError(const std::filesystem::path& path, std::string_view what) {
  const int error = errno;
  return absl::Status(absl::ErrnoToStatusCode(error), absl::StrCat(path.string(), ": ", std::strerror(error), "; give ",
                                                                   std::string(what), " that can be read"));
}

}  // namespace

absl::StatusOr<MappedFile> MappedFile::Open(const std::filesystem::path& path, std::string_view what) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return SystemError(path, what);
  struct stat status;
  absl::StatusOr<MappedFile> file = View("");
  if (fstat(descriptor, &status) != 0) {
    file = SystemError(path, what);
  } else if (!S_ISREG(status.st_mode)) {
    file = absl::FailedPreconditionError(absl::StrCat(path.string(), ": is ",
                                                      S_ISDIR(status.st_mode) ? "a folder" : "not a regular file",
                                                      "; give ", std::string(what)));
  } else if (status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const data = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (data == MAP_FAILED)
      file = SystemError(path, what);
    else
      file = MappedFile(static_cast<const char*>(data), size, true);
  }
  close(descriptor);
  return file;
}

MappedFile::~MappedFile() {
  if (mapped_) munmap(const_cast<char*>(data_), size_);
}

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

std::optional<FileIdentity> IdentityOf(const std::filesystem::path& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity(status.st_dev, status.st_ino);
}

bool IsVisible(const std::filesystem::path& path) { return !path.filename().string().starts_with('.'); }

absl::StatusOr<std::vector<std::filesystem::path>> FilesAt(const std::filesystem::path& path) {
  std::error_code error, ignored;
  if (!std::filesystem::is_directory(path, error)) return std::vector{path};
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file(ignored) && IsVisible(entry->path())) files.push_back(entry->path());
  if (error) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": ", error.message(), "; give a folder that can be read"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output) {
  const std::optional<FileIdentity> written = IdentityOf(output);
  if (written.has_value() && IdentityOf(input) == written)
    return absl::FailedPreconditionError(absl::StrCat(output.string(), ": is the input itself; write to another file"));
  return absl::OkStatus();
}

void FilesRead::Add(const std::filesystem::path& file) {
  if (const std::optional<FileIdentity> identity = IdentityOf(file)) identities_.insert(*identity);
}

void FilesRead::Add(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) Add(file);
}

absl::Status FilesRead::CheckNotReplacedBy(const std::filesystem::path& output) const {
  const std::optional<FileIdentity> identity = IdentityOf(output);
  if (!identity.has_value() || !identities_.contains(*identity)) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(output.string(), ": is read by this run and would be replaced; write to another file"));
}

absl::Status FilesRead::CheckNotReplacedIn(const std::filesystem::path& folder,
                                           std::span<const std::string_view> names) const {
  for (const std::string_view name : names)
    if (const absl::Status status = CheckNotReplacedBy(folder / name); !status.ok()) return status;
  return absl::OkStatus();
}

bool IsUtf16(std::string_view text) {
  constexpr std::size_t kCharacters = 3;
  if (text.size() < 2 * (kCharacters + 1)) return false;
  const bool has_mark = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  if (has_mark) text.remove_prefix(2);
  std::size_t even = 0, odd = 0;  // Zeros.
  for (std::size_t i = 0; i < kCharacters; ++i) {
    even += text[2 * i] == '\0';
    odd += text[2 * i + 1] == '\0';
  }
  return (even == kCharacters && odd == 0) || (odd == kCharacters && even == 0);
}

}  // namespace albtpu::formats
