#include "tables/file/atomic_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

namespace fs = std::filesystem;

constexpr absl::string_view kTemporaryPrefix = ".albtpu-", kTemporarySuffix = ".tmp";

absl::Status SystemError(const char* verb, const fs::path& path) {
  return absl::ErrnoToStatus(errno, absl::StrCat("cannot ", verb, " '", path.string(), "'"));
}

// A file that is removed again unless TakeName succeeds.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& folder) : folder_(folder) {
    static std::atomic<unsigned> counter = 0;
    do {
      path_ = folder_ / absl::StrCat(kTemporaryPrefix, getpid(), "-", counter++, kTemporarySuffix);
      descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
  }
  ~TemporaryFile() {
    if (descriptor_ < 0) return;
    close(descriptor_);
    if (!named_) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }

  bool Write(absl::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  bool Sync() { return fsync(descriptor_) == 0; }

  // Fails with EEXIST if `path` exists and is to be kept.
  bool TakeName(const fs::path& path, Existing existing) {
    named_ = existing == Existing::kReplace ? rename(path_.c_str(), path.c_str()) == 0 : RenameToNew(path);
    return named_;
  }

 private:
  bool RenameToNew(const fs::path& path) {
    if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
    // File systems without this rename, such as NFS, have links, and a link never replaces a file.
    return link(path_.c_str(), path.c_str()) == 0 && unlink(path_.c_str()) == 0;
  }

  fs::path folder_;
  fs::path path_;
  int descriptor_ = -1;
  bool named_ = false;
};

// Makes the name itself durable. Some file systems cannot sync a folder and return EINVAL, which is not an error
// here.
bool SyncFolder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES;  // A folder may be writable but not readable.
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL;
  const int error = errno;
  close(descriptor);
  errno = error;
  return synced;
}

absl::Status AlreadyThere(const fs::path& path) {
  return absl::AlreadyExistsError(
      absl::StrCat("'", path.string(), "' already exists: it is overwritten only on request"));
}

absl::Status CheckTarget(const fs::path& path, Existing existing) {
  if (!path.has_filename()) {
    return absl::InvalidArgumentError(absl::StrCat("'", path.string(), "' is not a file name"));
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return absl::OkStatus();
  if (!fs::is_regular_file(status)) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", path.string(), "' is not a regular file: it is not replaced"));
  }
  return existing == Existing::kKeep ? AlreadyThere(path) : absl::OkStatus();
}

}  // namespace

absl::Status WriteFileAtomically(const fs::path& path, absl::string_view bytes, Existing existing) {
  absl::Status target = CheckTarget(path, existing);
  if (!target.ok()) return target;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  TemporaryFile file(folder);
  if (!file.is_open()) return SystemError("write into folder", folder);
  if (!file.Write(bytes) || !file.Sync()) return SystemError("write", path);
  if (!file.TakeName(path, existing))
    return errno == EEXIST ? AlreadyThere(path) : SystemError("write", path);
  return SyncFolder(folder) ? absl::OkStatus() : SystemError("sync folder", folder);
}

bool IsTemporaryName(absl::string_view name) {
  return absl::StartsWith(name, kTemporaryPrefix) && absl::EndsWith(name, kTemporarySuffix);
}

}  // namespace albtpu
