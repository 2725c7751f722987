#include "tables/file/output_folder.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "tables/default_tables.h"

extern char** environ;

namespace albtpu {
namespace {

namespace fs = std::filesystem;

// Where pip installed the programs, its scripts name the Python that has the packages of pip.
const char* Python() {
  const char* python = std::getenv("ALBTPU_PYTHON");
  return python != nullptr && *python != '\0' ? python : "/usr/bin/python3";
}

// This process's environment, but for where Python finds the package, in which it must not write, and what matplotlib
// draws with.
std::vector<std::string> Environment() {
  std::vector<std::string> environment;
  for (char** each = environ; *each != nullptr; ++each)
    if (std::strncmp(*each, "PYTHONPATH=", 11) != 0) environment.emplace_back(*each);
  environment.push_back(absl::StrCat("PYTHONPATH=", (InstalledDataDirectory() / "python").string()));
  environment.emplace_back("PYTHONDONTWRITEBYTECODE=1");
  environment.emplace_back("MPLBACKEND=Agg");
  return environment;
}

std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

absl::Status NotWritable(const fs::path& folder) {
  return absl::PermissionDeniedError(
      absl::StrCat(folder.string(), ": cannot be written to: ", std::strerror(errno), "; give another folder"));
}

absl::Status PrepareFolder(const fs::path& folder, Existing existing) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (!fs::is_directory(folder)) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": cannot be made; give a folder, or a new name in a folder that exists"));
  }
  if (!fs::is_empty(folder, error) && existing == Existing::kKeep) {
    return absl::AlreadyExistsError(
        absl::StrCat(folder.string(), ": is not empty; give another folder, or replace what is there by --overwrite"));
  }
  return access(folder.c_str(), W_OK) == 0 ? absl::OkStatus() : NotWritable(folder);
}

HiddenFolder::HiddenFolder(const fs::path& folder) : folder_(folder) {
  std::string name = (folder / ".albtpu-XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) path_ = name;
}

HiddenFolder::~HiddenFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

absl::Status HiddenFolder::Publish(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    std::error_code error;
    fs::rename(path_ / name, folder_ / name, error);
    if (error)
      return absl::DataLossError(absl::StrCat((folder_ / name).string(), ": cannot be written: ", error.message()));
  }
  return absl::OkStatus();
}

absl::Status RunPython(std::vector<std::string> arguments) {
  const char* const python = Python();
  arguments.insert(arguments.begin(), {python, "-B"});
  std::vector<std::string> environment = Environment();
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    return absl::InternalError(absl::StrCat("no pipe to ", python, ": ", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failure =
      posix_spawn(&child, python, &actions, nullptr, Pointers(arguments).data(), Pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  std::string said;
  std::array<char, 4096> bytes;
  for (ssize_t count; failure == 0 && (count = read(pipe_ends[0], bytes.data(), bytes.size())) != 0;) {
    if (count > 0) said.append(bytes.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  close(pipe_ends[0]);
  if (failure != 0) return absl::FailedPreconditionError(absl::StrCat(python, ": ", std::strerror(failure)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return absl::OkStatus();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const std::string last = said.substr(said.rfind('\n') + 1);
  return absl::FailedPreconditionError(last.empty() ? absl::StrCat(python, " failed") : last);
}

}  // namespace albtpu
