#include "config/toml/toml_file.h"

#include <fstream>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "formats/text/one_line.h"

namespace albtpu::config {
namespace {

namespace fs = std::filesystem;

// A hundred times what a survey needs. A longer text could nest keys so deeply ("a.a.a ...") that the TOML parser,
// which recurses into each level, would overflow the stack.
constexpr std::size_t kMostBytes = 32768;

}  // namespace

absl::StatusOr<toml::table> ParseToml(std::string_view text, const TomlKind& kind) {
  if (text.size() > kMostBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("has ", text.size(), " bytes (", std::string(kind.name), " has at most ", kMostBytes,
                     "); give the TOML that describes ", std::string(kind.subject)));
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(absl::StrCat("line ", error.source().begin.line, ": is not TOML (",
                                                   formats::OneLine(std::string(error.description())),
                                                   "); correct it"));
  }
}

absl::StatusOr<std::string> ReadTomlText(const fs::path& path, const TomlKind& kind) {
  std::error_code unknown;
  if (!fs::exists(path, unknown)) {
    return InFile(path,
                  absl::NotFoundError(absl::StrCat("does not exist; check ", std::string(kind.given_by))));
  }
  if (!fs::is_regular_file(path, unknown))
    return InFile(path, absl::FailedPreconditionError("is not a regular file; give a file of TOML"));
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file && !file.eof())
    return InFile(path, absl::UnavailableError("cannot be read; check its permissions"));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

absl::Status InFile(const fs::path& path, const absl::Status& problem) {
  return absl::Status(problem.code(), absl::StrCat(path.string(), ": ", problem.message()));
}

}  // namespace albtpu::config
