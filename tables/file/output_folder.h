// A folder of outputs that appear together: the files of a report, some of them drawn by Python.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "tables/file/existing.h"

namespace albtpu {

// Makes the folder. AlreadyExists if it has files and is to be kept; NotFound if it cannot be made; PermissionDenied if
// it cannot be written to.
absl::Status PrepareFolder(const std::filesystem::path& folder, Existing existing);

// PermissionDenied, with the reason in errno.
absl::Status NotWritable(const std::filesystem::path& folder);

// A hidden folder inside another one, removed by the destructor.
class HiddenFolder {
 public:
  explicit HiddenFolder(const std::filesystem::path& folder);
  ~HiddenFolder();
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }  // empty if it could not be made

  // Moves files of these names to the folder outside, in this order: the page, which refers to the others, is the last.
  absl::Status Publish(const std::vector<std::string>& names) const;

 private:
  std::filesystem::path folder_, path_;
};

// Runs the Python that the environment variable `ALBTPU_PYTHON` names, or /usr/bin/python3, with the installed package
// of the client. FailedPrecondition with the last line of its standard error.
absl::Status RunPython(std::vector<std::string> arguments);

}  // namespace albtpu
