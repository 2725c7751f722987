// A file that appears under its name only when it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/file/table_io.h"

namespace albtpu::client {

// Writes to a file without a name in the same folder, which goes when the program does. Commit() syncs and
// gives it its name. Where the file system has no such files (NFS), it has a temporary name, and without
// Commit() is removed by the destructor or when a signal (HUP, INT, TERM) ends the program.
class OutputFile {
 public:
  // AlreadyExists when `path` exists and is to be kept. FailedPrecondition when it is something other than a
  // regular file, which a rename would replace (a device, a folder).
  static absl::StatusOr<OutputFile> Create(const std::filesystem::path& path, Existing existing);

  OutputFile(OutputFile&&) = default;
  OutputFile& operator=(OutputFile&&) = default;

  // In large pieces: nothing is held back.
  absl::Status Write(std::string_view bytes);
  std::uint64_t size() const;  // Bytes written.

  // Brings all bytes to the disk, so that Commit() has only the name left to fail on.
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

// FailedPrecondition when `output` is the file `input`, by whatever name: it would be replaced while it is
// read.
absl::Status CheckNotTheSameFile(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace albtpu::client
