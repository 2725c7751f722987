// A file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/file/existing.h"

namespace albtpu {

// Writes to an unnamed file in the same folder, which the system removes when the program ends. Commit() syncs the
// file and gives it its name. On file systems without unnamed files (NFS) it has a temporary name; unless it is
// committed, the destructor removes it, or the signal handler when a signal (HUP, INT, TERM) ends the program.
class OutputFile {
 public:
  // AlreadyExists when `path` exists and is to be kept. FailedPrecondition when `path` is not a regular file: the
  // rename would replace a device or a folder.
  static absl::StatusOr<OutputFile> Create(const std::filesystem::path& path, Existing existing);

  OutputFile(OutputFile&&) = default;
  OutputFile& operator=(OutputFile&&) = default;

  // Unbuffered: write large pieces.
  absl::Status Write(std::string_view bytes);
  // Replaces bytes that were written before. Requires offset + bytes.size() <= size().
  absl::Status WriteAt(std::uint64_t offset, std::string_view bytes);
  std::uint64_t size() const;  // Bytes written.

  // Brings all bytes to disk, so that only the renaming in Commit() can still fail.
  absl::Status Sync();
  absl::Status Commit();

 private:
  struct Temporary;
  explicit OutputFile(std::unique_ptr<Temporary> temporary);

  struct Discard {
    void operator()(Temporary* temporary) const;
  };
  std::unique_ptr<Temporary, Discard> temporary_;
};

// Writes a whole file, or nothing.
absl::Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes, Existing existing);

// Whether this is the name of such a temporary file, as a killed writer leaves it behind.
bool IsTemporaryName(std::string_view name);

}  // namespace albtpu
