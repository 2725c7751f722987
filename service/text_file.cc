#include "service/text_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

// More than the certificates of all authorities that a browser trusts.
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

}  // namespace

absl::StatusOr<std::string> ReadTextFile(const std::string& flag, const std::filesystem::path& path) {
  const std::string where = absl::StrCat(flag, ": ", path.string());
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(path, error);
  if (is_folder) return absl::InvalidArgumentError(absl::StrCat(where, ": is a folder: expected a file"));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return absl::ErrnoToStatus(errno == 0 ? EIO : errno, where);
  std::string text(kMaxBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) return absl::DataLossError(absl::StrCat(where, ": cannot be read"));
  if (text.size() <= kMaxBytes) return text;
  return absl::InvalidArgumentError(absl::StrCat(where, ": has more than 1 MiB; check that it is the right file"));
}

}  // namespace albtpu
