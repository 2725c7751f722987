#include "annotate/run/file_jobs.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/exit_status.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;

using Extensions = std::vector<std::string>;

bool HasOneOf(const fs::path& path, const Extensions& extensions) {
  return std::ranges::any_of(extensions, [&](const std::string& each) { return HasExtension(path, each); });
}

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool IsSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

// The files in `folder`, and in its subfolders with --recursive, ordered by name.
absl::StatusOr<std::vector<fs::path>> FilesIn(const fs::path& folder, const Extensions& extensions,
                                              const FileOptions& options) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;  // An entry that disappeared is not annotated.
    if (entry->is_directory(ignored)) {
      if (!options.recursive || IsSame(entry->path(), options.output_folder)) {
        entry.disable_recursion_pending();
      }
    } else if (entry->is_regular_file(ignored) && HasOneOf(entry->path(), extensions)) {
      files.push_back(entry->path());
    }
  }
  if (error) {
    return absl::FailedPreconditionError(
        absl::StrCat(folder.string(), ": ", error.message(), "; give a folder that can be read"));
  }
  if (files.empty()) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": no ", absl::StrJoin(extensions, " or "), " file in this folder",
                     options.recursive ? "" : " (subfolders were not searched)",
                     "; give a folder that has some", options.recursive ? "" : ", or add --recursive"));
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The name of the output for an input of this name.
fs::path OutputName(const fs::path& name, const Extensions& extensions, const std::string& output_extension) {
  if (output_extension.empty() || HasExtension(name, output_extension)) return name;
  fs::path output = name;
  if (HasOneOf(name, extensions)) output.replace_extension();
  return output += output_extension;
}

}  // namespace

bool HasExtension(const fs::path& path, const std::string& extension) {
  return absl::AsciiStrToLower(path.extension().string()) == extension;
}

absl::StatusOr<std::vector<Job>> FindJobs(const std::string& command, const Extensions& extensions,
                                          const FileOptions& options) {
  const std::vector<std::string>& files = options.files;
  const std::string& extension = extensions.front();
  if (options.output_folder.empty()) {
    if (files.size() != 2 || options.recursive) {
      return formats::UsageError(absl::StrCat(command, ": ", files.size(), " files; give IN", extension,
                                              " OUT", extension,
                                              ", or --output-dir DIR and any number of inputs"));
    }
    return std::vector<Job>{{files[0], files[1]}};
  }
  if (!IsFolder(options.output_folder)) {
    return absl::NotFoundError(
        absl::StrCat("--output-dir: ", options.output_folder, " is not a folder; give one that exists"));
  }
  std::vector<Job> jobs;
  std::map<fs::path, fs::path> input_of;
  const auto add = [&](const fs::path& input, const fs::path& input_name) -> absl::Status {
    const fs::path name = OutputName(input_name, extensions, options.output_extension);
    const auto [other, is_new] = input_of.emplace(name.lexically_normal(), input);
    if (!is_new) {
      return formats::UsageError(absl::StrCat(
          "--output-dir: two ", options.output_extension.empty() ? "inputs are" : "outputs would be",
          " called ", name.string(), " (", other->second.string(), ", ", input.string(),
          "); annotate them one at a time, as IN", extension, " OUT", extension));
    }
    jobs.push_back({input, options.output_folder / name, name.has_parent_path()});
    return absl::OkStatus();
  };
  for (const std::string& file : files) {
    if (!IsFolder(file)) {
      if (absl::Status status = add(file, fs::path(file).filename()); !status.ok()) return status;
      continue;
    }
    const absl::StatusOr<std::vector<fs::path>> inputs = FilesIn(file, extensions, options);
    if (!inputs.ok()) return inputs.status();
    for (const fs::path& input : *inputs) {
      if (absl::Status status = add(input, input.lexically_relative(file)); !status.ok()) return status;
    }
  }
  return jobs;
}

}  // namespace albtpu::annotate
