// A file of TOML as text and as a table, with one message for what is wrong with it.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu::config {

// How messages speak of a kind of file.
struct TomlKind {
  std::string_view name;      // "a survey file"
  std::string_view subject;   // what it describes: "the survey"
  std::string_view given_by;  // what names it: "the path of --survey"
};

// InvalidArgument "line 3: is not TOML ..." or "has 40000 bytes ...".
absl::StatusOr<toml::table> ParseToml(std::string_view text, const TomlKind& kind);

// The text of a file, or a little more than ParseToml takes.
absl::StatusOr<std::string> ReadTomlText(const std::filesystem::path& path, const TomlKind& kind);

// A problem of the text, with the path of its file before it.
absl::Status InFile(const std::filesystem::path& path, const absl::Status& problem);

}  // namespace albtpu::config
