#include "survey/files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "survey/files/temporary_files.h"

namespace albtpu::client {
namespace {

// The disk is set to work each time that so many bytes have come, so that syncing does not begin at the end.
constexpr std::uint64_t kWriteBehind = 32 << 20;

// What the system said of `path`, and what would be right.
absl::Status SystemError(const std::filesystem::path& path, std::string_view remedy) {
  const int error = errno;
  return absl::Status(absl::ErrnoToStatusCode(error),
                      absl::StrCat(path.string(), ": ", std::strerror(error), ": ", std::string(remedy)));
}

constexpr std::string_view kWritingFailed = "nothing was kept; make room, or write elsewhere";

absl::Status CheckTarget(const std::filesystem::path& path, Existing existing) {
  struct stat target;
  if (stat(path.c_str(), &target) != 0) return absl::OkStatus();
  if (!S_ISREG(target.st_mode)) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": is not a regular file: name a file to write"));
  }
  if (existing == Existing::kKeep) {
    return absl::AlreadyExistsError(
        absl::StrCat(path.string(), ": exists already: choose another name, or --overwrite it"));
  }
  return absl::OkStatus();
}

// Renames without replacing. File systems that cannot do this in one step get a check and a rename.
int RenameToFreeName(const char* from, const char* to) {
  const int result = renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
  if (result == 0 || (errno != EINVAL && errno != ENOSYS)) return result;
  if (access(to, F_OK) == 0) {
    errno = EEXIST;
    return -1;
  }
  return std::rename(from, to);
}

std::string InProc(int descriptor) { return absl::StrCat("/proc/self/fd/", descriptor); }

// A file in `folder` that has no name, and is gone when the program is, whatever ends it. Negative where the
// file system has none such (NFS) or they could not get a name.
int OpenNameless(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0 || access(InProc(descriptor).c_str(), F_OK) == 0) return descriptor;
  close(descriptor);
  return -1;
}

// Calls `make` with names of temporary files in `folder` until it makes one that did not exist, or fails for
// another reason; returns its result.
template <typename Make>
int MakeTemporary(const std::filesystem::path& folder, std::string& name, Make make) {
  int result = -1;
  for (int attempt = 0; result < 0; ++attempt) {
    name = folder / absl::StrCat(".albtpu-", getpid(), "-", attempt, ".part");
    result = make(name.c_str());
    if (result < 0 && errno != EEXIST) break;
  }
  return result;
}

std::filesystem::path FolderOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

struct OutputFile::Temporary {
  std::filesystem::path path;  // Where the whole file will be.
  Existing existing;
  int descriptor;                   // Negative once it is closed.
  std::string temporary_path = {};  // Empty while there is nothing to remove.
  std::uint64_t size = 0, handed_to_disk = 0;
  std::optional<RemovedOnSignal> removed_on_signal = {};
};

void OutputFile::Discard::operator()(Temporary* temporary) const {
  if (temporary->descriptor >= 0) close(temporary->descriptor);
  if (!temporary->temporary_path.empty()) unlink(temporary->temporary_path.c_str());
  delete temporary;
}

OutputFile::OutputFile(std::unique_ptr<Temporary> temporary) : temporary_(temporary.release()) {}

absl::StatusOr<OutputFile> OutputFile::Create(const std::filesystem::path& path, Existing existing) {
  if (absl::Status status = CheckTarget(path, existing); !status.ok()) return status;
  std::unique_ptr<Temporary> temporary(new Temporary{path, existing, OpenNameless(FolderOf(path))});
  if (temporary->descriptor >= 0) return OutputFile(std::move(temporary));
  temporary->descriptor = MakeTemporary(FolderOf(path), temporary->temporary_path, [](const char* name) {
    return open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  });
  if (temporary->descriptor < 0) return SystemError(path, "name a folder that exists and can be written");
  temporary->removed_on_signal.emplace(temporary->temporary_path);
  return OutputFile(std::move(temporary));
}

absl::Status OutputFile::Write(std::string_view bytes) {
  Temporary& temporary = *temporary_;
  while (!bytes.empty()) {
    const ssize_t count = write(temporary.descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return SystemError(temporary.path, kWritingFailed);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    temporary.size += static_cast<std::uint64_t>(count);
  }
  if (temporary.size - temporary.handed_to_disk >= kWriteBehind) {
    // Begins to write and does not wait. Where this cannot be done, Sync() does all of it.
    static_cast<void>(sync_file_range(temporary.descriptor, static_cast<off_t>(temporary.handed_to_disk),
                                      static_cast<off_t>(temporary.size - temporary.handed_to_disk),
                                      SYNC_FILE_RANGE_WRITE));
    temporary.handed_to_disk = temporary.size;
  }
  return absl::OkStatus();
}

std::uint64_t OutputFile::size() const { return temporary_->size; }

absl::Status OutputFile::Sync() {
  if (fsync(temporary_->descriptor) == 0) return absl::OkStatus();
  return SystemError(temporary_->path, kWritingFailed);
}

absl::Status OutputFile::Commit() {
  Temporary& temporary = *temporary_;
  if (absl::Status status = Sync(); !status.ok()) return status;
  if (temporary.temporary_path.empty()) {
    std::string name;
    const std::string nameless = InProc(temporary.descriptor);
    const int linked = MakeTemporary(FolderOf(temporary.path), name, [&nameless](const char* new_name) {
      return linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, new_name, AT_SYMLINK_FOLLOW);
    });
    if (linked != 0) return SystemError(temporary.path, kWritingFailed);
    temporary.removed_on_signal.emplace(name);
    temporary.temporary_path = name;
  }
  if (close(std::exchange(temporary.descriptor, -1)) != 0) return SystemError(temporary.path, kWritingFailed);
  // Again: somebody may have put a file there while we worked.
  if (absl::Status status = CheckTarget(temporary.path, temporary.existing); !status.ok()) return status;
  const char* from = temporary.temporary_path.c_str();
  const char* to = temporary.path.c_str();
  const int renamed =
      temporary.existing == Existing::kReplace ? std::rename(from, to) : RenameToFreeName(from, to);
  if (renamed != 0) return SystemError(temporary.path, "nothing was kept; choose another name");
  temporary.temporary_path.clear();
  // The rename lasts only when the folder is on disk too; a file system that cannot sync folders is no
  // failure.
  const int folder = open(FolderOf(temporary.path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
  return absl::OkStatus();
}

absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored)) {
    return absl::FailedPreconditionError(
        absl::StrCat(output.string(), ": is the input itself: write to another file"));
  }
  return absl::OkStatus();
}

}  // namespace albtpu::client
