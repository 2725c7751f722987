// Which files a command reads, and where each output goes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::client {

// The flags that say so; all commands on files share them.
struct FileOptions {
  std::vector<std::string> files;  // IN OUT, or inputs and folders of inputs.
  std::string output_folder;       // --output-dir
  bool recursive = false;          // --recursive
  bool resume = false;             // --resume
};

// One file to annotate.
struct Job {
  std::filesystem::path input, output;
  bool in_subfolder = false;  // Of the output folder; it may have to be made.
};

// IN OUT, or every input into the output folder. A folder stands for all files in it of `extension` (".las"),
// in the order of their names; with --recursive also those of its subfolders, which the output folder
// repeats. What lies in the output folder is no input. IsUsageError when the files do not say which, or when
// two would go to one name.
absl::StatusOr<std::vector<Job>> FindJobs(const std::string& command, const std::string& extension,
                                          const FileOptions& options);

}  // namespace albtpu::client
