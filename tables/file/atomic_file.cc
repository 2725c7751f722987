#include "tables/file/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

// Writing to disk is started whenever this many bytes have accumulated, so that the final sync has little left to do.
constexpr std::uint64_t kWriteBehind = 32 << 20;

// The system's last error, for `path`.
absl::Status SystemError(const std::filesystem::path& path, std::string_view suggestion) {
  const int error = errno;
  return absl::Status(
      absl::ErrnoToStatusCode(error),
      absl::StrCat(path.string(), ": ", std::strerror(error), " (no output was written); ", std::string(suggestion)));
}

constexpr std::string_view kTemporaryPrefix = ".albtpu-", kTemporarySuffix = ".tmp";
constexpr std::string_view kMakeRoom = "free some space, or write elsewhere";

absl::Status AlreadyThere(const std::filesystem::path& path) {
  return absl::AlreadyExistsError(
      absl::StrCat(path.string(), ": already exists; choose another name, or add --overwrite"));
}

absl::Status CheckTarget(const std::filesystem::path& path, Existing existing) {
  struct stat target;
  if (lstat(path.c_str(), &target) != 0) return absl::OkStatus();
  if (S_ISLNK(target.st_mode)) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": is a link, which a new file would replace; give the name of the file itself"));
  }
  if (!S_ISREG(target.st_mode))
    return absl::FailedPreconditionError(absl::StrCat(path.string(), ": is not a regular file; give a file to write"));
  return existing == Existing::kKeep ? AlreadyThere(path) : absl::OkStatus();
}

// Renames without replacing an existing file. File systems without this rename, such as NFS, have links, and a link
// never replaces a file; those without links get a check and a rename.
int RenameToFreeName(const char* from, const char* to) {
  int result = renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
  if (result == 0 || (errno != EINVAL && errno != ENOSYS)) return result;
  result = link(from, to);
  if (result == 0) return unlink(from);
  if (errno != EPERM && errno != ENOSYS && errno != EOPNOTSUPP) return result;
  if (access(to, F_OK) == 0) {
    errno = EEXIST;
    return -1;
  }
  return std::rename(from, to);
}

std::string InProc(int descriptor) { return absl::StrCat("/proc/self/fd/", descriptor); }

// Opens an unnamed file in `folder`, which disappears with the program, however the program ends. Negative if the
// file system has no unnamed files (NFS) or if the file could not be named later.
int OpenUnnamed(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0 || access(InProc(descriptor).c_str(), F_OK) == 0) return descriptor;
  close(descriptor);
  return -1;
}

// Calls `make` with names of temporary files in `folder` until it succeeds, or fails for another reason than that
// the name is taken; returns its result.
template <typename Make>
int MakeTemporary(const std::filesystem::path& folder, std::string& name, Make make) {
  int result = -1;
  for (int attempt = 0; result < 0; ++attempt) {
    name = folder / absl::StrCat(std::string(kTemporaryPrefix), getpid(), "-", attempt, std::string(kTemporarySuffix));
    result = make(name.c_str());
    if (result < 0 && errno != EEXIST) break;
  }
  return result;
}

std::filesystem::path FolderOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// Temporary files that must not outlive the program, even when a signal ends it. A signal handler may neither
// allocate nor lock, so their names live in fixed slots. Every command needs at most two. A file for which no slot is
// left is not removed on a signal.
struct Slot {
  std::atomic<bool> taken = false;  // By a RemovedOnSignal.
  std::atomic<bool> armed = false;  // `path` is complete.
  char path[PATH_MAX];
};
constexpr int kSlots = 8;
std::array<Slot, kSlots> slots;

extern "C" void RemoveTemporariesAndEnd(int signal) {
  for (Slot& slot : slots)
    if (slot.armed) unlink(slot.path);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void InstallHandlers() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) continue;  // Stay ignored, as HUP under `nohup`.
    action.sa_handler = RemoveTemporariesAndEnd;
    sigaction(signal, &action, nullptr);
  }
}

// Removes `path` when a signal (HUP, INT, TERM) ends the program while this object lives. The destructor does not
// remove the file.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path) {
    static const bool installed = (InstallHandlers(), true);
    static_cast<void>(installed);
    if (path.size() >= PATH_MAX) return;
    for (Slot& slot : slots) {
      if (slot.taken.exchange(true)) continue;
      std::memcpy(slot.path, path.c_str(), path.size() + 1);
      slot.armed = true;
      slot_ = &slot;
      return;
    }
  }
  ~RemovedOnSignal() {
    if (slot_ == nullptr) return;
    slot_->armed = false;
    slot_->taken = false;
  }
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  Slot* slot_ = nullptr;
};

}  // namespace

struct OutputFile::Temporary {
  std::filesystem::path path;  // The final name.
  Existing existing;
  int descriptor;                   // Negative once closed.
  std::string temporary_path = {};  // Empty while there is no name to remove.
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
  RETURN_IF_ERROR(CheckTarget(path, existing));
  std::unique_ptr<Temporary> temporary(new Temporary{path, existing, OpenUnnamed(FolderOf(path))});
  if (temporary->descriptor >= 0) return OutputFile(std::move(temporary));
  temporary->descriptor = MakeTemporary(FolderOf(path), temporary->temporary_path, [](const char* name) {
    return open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  });
  if (temporary->descriptor < 0) return SystemError(path, "write to a folder that exists and is writable");
  temporary->removed_on_signal.emplace(temporary->temporary_path);
  return OutputFile(std::move(temporary));
}

absl::Status OutputFile::Write(std::string_view bytes) {
  Temporary& temporary = *temporary_;
  while (!bytes.empty()) {
    const ssize_t count = write(temporary.descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return SystemError(temporary.path, kMakeRoom);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    temporary.size += static_cast<std::uint64_t>(count);
  }
  if (temporary.size - temporary.handed_to_disk >= kWriteBehind) {
    // Starts writing without waiting for it. If this fails, Sync() does all the work.
    static_cast<void>(sync_file_range(temporary.descriptor, static_cast<off_t>(temporary.handed_to_disk),
                                      static_cast<off_t>(temporary.size - temporary.handed_to_disk),
                                      SYNC_FILE_RANGE_WRITE));
    temporary.handed_to_disk = temporary.size;
  }
  return absl::OkStatus();
}

absl::Status OutputFile::WriteAt(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = pwrite(temporary_->descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return SystemError(temporary_->path, kMakeRoom);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return absl::OkStatus();
}

std::uint64_t OutputFile::size() const { return temporary_->size; }

absl::Status OutputFile::Sync() {
  if (fsync(temporary_->descriptor) == 0) return absl::OkStatus();
  return SystemError(temporary_->path, kMakeRoom);
}

absl::Status OutputFile::Commit() {
  Temporary& temporary = *temporary_;
  RETURN_IF_ERROR(Sync());
  if (temporary.temporary_path.empty()) {
    std::string name;
    const std::string unnamed = InProc(temporary.descriptor);
    const int linked = MakeTemporary(FolderOf(temporary.path), name, [&unnamed](const char* new_name) {
      return linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, new_name, AT_SYMLINK_FOLLOW);
    });
    if (linked != 0) return SystemError(temporary.path, kMakeRoom);
    temporary.removed_on_signal.emplace(name);
    temporary.temporary_path = name;
  }
  if (close(std::exchange(temporary.descriptor, -1)) != 0) return SystemError(temporary.path, kMakeRoom);
  // Check again: another program may have created the file meanwhile.
  RETURN_IF_ERROR(CheckTarget(temporary.path, temporary.existing));
  const char* from = temporary.temporary_path.c_str();
  const char* to = temporary.path.c_str();
  const int renamed = temporary.existing == Existing::kReplace ? std::rename(from, to) : RenameToFreeName(from, to);
  if (renamed != 0 && errno == EEXIST) return AlreadyThere(temporary.path);
  if (renamed != 0) return SystemError(temporary.path, "choose another name");
  temporary.temporary_path.clear();
  // The rename is permanent only when the folder is on disk, too. Some file systems cannot sync folders; that is not
  // an error.
  const int folder = open(FolderOf(temporary.path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
  return absl::OkStatus();
}

absl::Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes, Existing existing) {
  ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, existing));
  RETURN_IF_ERROR(file.Write(bytes));
  return file.Commit();
}

bool IsTemporaryName(std::string_view name) {
  return name.starts_with(kTemporaryPrefix) && name.ends_with(kTemporarySuffix);
}

}  // namespace albtpu
