// Access to files: inputs as read-only memory, checked for a change while they are read, and outputs that appear only
// when they are complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/file/atomic_file.h"

namespace albtpu::formats {

// A whole regular file as read-only memory, or memory in the place of one.
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

// What is the same for all names of one file: hard and symbolic links, other ways to its folder.
using FileIdentity = std::pair<dev_t, ino_t>;
std::optional<FileIdentity> IdentityOf(const std::filesystem::path& path);  // nullopt if there is no such file.

// Whether a file or folder that lies in a given one belongs to the user: programs keep their own under names that begin
// with a dot, such as the half of a file that a copy has not finished. Nothing is said of the others.
bool IsVisible(const std::filesystem::path& path);

// `path` itself; or, if it is a folder, the regular files in it that are visible, by name, which may be none.
// FailedPrecondition when the folder cannot be read.
absl::StatusOr<std::vector<std::filesystem::path>> FilesAt(const std::filesystem::path& path);

// FailedPrecondition when `output` and `input` are the same file, under whatever names: the input would be replaced
// while it is read.
absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output);

// The files that a run reads; absent ones are ignored. With --overwrite, an output of the name of one of them
// would replace it.
class FilesRead {
 public:
  void Add(const std::filesystem::path& file);
  void Add(const std::vector<std::filesystem::path>& files);

  // FailedPrecondition when `output` is one of them, under whatever name.
  absl::Status CheckNotReplacedBy(const std::filesystem::path& output) const;
  // The same of files of these names in a folder.
  absl::Status CheckNotReplacedIn(const std::filesystem::path& folder, std::span<const std::string_view> names) const;

 private:
  std::set<FileIdentity> identities_;
};

// Whether a text is UTF-16, as spreadsheets write it, by its beginning: the mark of its byte order before characters
// of which one byte is 0, or such characters alone.
bool IsUtf16(std::string_view text);

}  // namespace albtpu::formats
