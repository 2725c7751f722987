#include "validation/report/plotting.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "absl/strings/str_cat.h"

extern char** environ;

namespace albtpu {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // the one that Debian's python3-matplotlib belongs to

std::string LastLine(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

std::string DrawFigures(const std::filesystem::path& plots, const std::filesystem::path& folder,
                        const std::vector<std::string>& figures) {
  if (figures.empty()) return "";
  std::vector<std::string> words = {kPython, "-B", (plots / "draw.py").string(), folder.string(),
                                    folder.string()};
  words.insert(words.end(), figures.begin(), figures.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const std::filesystem::path messages = folder / "draw.log";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  pid_t child = 0;
  const int failure = posix_spawn(&child, kPython, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return absl::StrCat(std::strerror(failure), ": ", kPython);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string said = LastLine(messages);
  std::error_code ignored;
  std::filesystem::remove(messages, ignored);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return said.empty() ? absl::StrCat(kPython, " failed") : said;
}

}  // namespace albtpu
