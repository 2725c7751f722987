// The files that a command reads, and the place of each output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::annotate {

// The flags that choose files; all commands that work on files share them.
struct FileOptions {
  std::vector<std::string> files;  // IN OUT, or input files and folders.
  std::string output_folder;       // --output-dir
  bool recursive = false;          // --recursive
  bool resume = false;             // --resume
  std::string output_extension;    // Of the outputs in the folder; empty: that of each input.
};

// One file to annotate.
struct Job {
  std::filesystem::path input, output;
  bool in_subfolder = false;  // Of the output folder; the subfolder may not exist yet.
};

// Whether the name ends in this extension (".las"), in any case.
bool HasExtension(const std::filesystem::path& path, const std::string& extension);

// IN OUT, or every input into the output folder. A folder stands for all files in it with one of the `extensions`
// (".las"), ordered by name; with --recursive also for those in its subfolders, which are recreated in the output
// folder. Files inside the output folder are never inputs. Fails with IsUsageError when the arguments are neither of
// the two, or when two outputs would have the same name.
absl::StatusOr<std::vector<Job>> FindJobs(const std::string& command,
                                          const std::vector<std::string>& extensions,
                                          const FileOptions& options);

}  // namespace albtpu::annotate
