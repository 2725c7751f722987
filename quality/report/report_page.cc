#include "quality/report/report_page.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "tables/default_tables.h"

extern char** environ;

namespace albtpu::quality {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // For which Debian's packages are installed.

// This process's environment, but for where Python finds the package and where matplotlib keeps what it caches.
std::vector<std::string> Environment() {
  std::vector<std::string> environment;
  for (char** each = environ; *each != nullptr; ++each)
    if (std::strncmp(*each, "PYTHONPATH=", 11) != 0) environment.emplace_back(*each);
  environment.push_back(absl::StrCat("PYTHONPATH=", (InstalledDataDirectory() / "python").string()));
  environment.emplace_back("MPLBACKEND=Agg");
  return environment;
}

std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Runs Python. The message of a failure is the last line of its standard error.
absl::Status RunPython(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {kPython, "-B"});
  std::vector<std::string> environment = Environment();
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    return absl::InternalError(absl::StrCat("no pipe to ", kPython, ": ", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawn(&child, kPython, &actions, nullptr, Pointers(arguments).data(),
                                  Pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  std::string said;
  std::array<char, 4096> bytes;
  for (ssize_t count; failure == 0 && (count = read(pipe_ends[0], bytes.data(), bytes.size())) != 0;) {
    if (count > 0) said.append(bytes.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  close(pipe_ends[0]);
  if (failure != 0) return absl::FailedPreconditionError(absl::StrCat(kPython, ": ", std::strerror(failure)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return absl::OkStatus();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const std::string last = said.substr(said.rfind('\n') + 1);
  return absl::FailedPreconditionError(last.empty() ? absl::StrCat(kPython, " failed") : last);
}

}  // namespace

absl::Status CheckPageCanBeDrawn() {
  const absl::Status status = RunPython({"-c", "import matplotlib, netCDF4, numpy, albtpu.report"});
  if (status.ok()) return status;
  return absl::FailedPreconditionError(
      absl::StrCat("the page cannot be drawn (", status.message(),
                   "); install python3-matplotlib and python3-netcdf4, or leave out the page by --no-page"));
}

absl::Status DrawPage(const std::filesystem::path& folder) {
  const absl::Status status = RunPython({"-m", "albtpu.report", folder.string()});
  if (status.ok()) return status;
  return absl::InternalError(absl::StrCat("the page cannot be drawn: ", status.message(),
                                          "; --no-page leaves it out, please report this"));
}

}  // namespace albtpu::quality
