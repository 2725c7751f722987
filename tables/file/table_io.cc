#include "tables/file/table_io.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <new>
#include <string>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"
#include "tables/file/atomic_file.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"

namespace albtpu {
namespace {

namespace fs = std::filesystem;

constexpr char kOutOfMemory[] = "there is not enough memory for this table";

absl::Status WithPath(const fs::path& path, const absl::Status& status) {
  return absl::Status(status.code(), absl::StrCat(path.string(), ": ", status.message()));
}

// A file that shrinks while it is read sets no error number.
absl::Status SystemError(int error) { return absl::ErrnoToStatus(error == 0 ? EIO : error, "cannot be read"); }

// Reads the whole file, or only its first bytes if they show that it is not a table.
absl::StatusOr<std::string> ReadSealedFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return absl::NotFoundError("no such file");
  if (error) return SystemError(error.value());
  if (!fs::is_regular_file(status)) return absl::DataLossError("is not a regular file: not a table");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return SystemError(errno);
  const std::uintmax_t length = fs::file_size(path, error);
  if (error) return SystemError(error.value());

  std::string file(std::min<std::uintmax_t>(length, seal::kSize), '\0');
  const auto read_from = [&](std::size_t offset) {
    return stream.read(file.data() + offset, static_cast<std::streamsize>(file.size() - offset)).good();
  };
  if (!read_from(0)) return SystemError(errno);
  RETURN_IF_ERROR(seal::CheckHeader(file, length));
  file.resize(length);
  if (!read_from(seal::kSize)) return SystemError(errno);
  return file;
}

// `decode` makes the table of the bytes of the file.
template <typename Decode>
auto Read(const fs::path& path, const Decode& decode) -> decltype(decode(std::string())) try {
  const absl::StatusOr<std::string> file = ReadSealedFile(path);
  if (!file.ok()) return WithPath(path, file.status());
  auto table = decode(*file);
  if (!table.ok()) return WithPath(path, table.status());
  return table;
} catch (const std::bad_alloc&) {
  return WithPath(path, absl::ResourceExhaustedError(kOutOfMemory));
}

absl::Status Write(const Table& table, const fs::path& path, Existing existing) {
  ASSIGN_OR_RETURN(const std::string file, EncodeTable(table));
  return WriteFileAtomically(path, file, existing);
}

}  // namespace

absl::StatusOr<Table> ReadTable(const fs::path& path, const TableSchema& schema) {
  return Read(path, [&](const std::string& file) { return DecodeTable(file, schema); });
}

absl::StatusOr<UncertaintyTable> ReadTable(const fs::path& path) {
  return Read(path, [](const std::string& file) { return DecodeTable(file); });
}

absl::Status WriteTable(const Table& table, const fs::path& path, Existing existing) try {
  return Write(table, path, existing);
} catch (const std::bad_alloc&) {
  return WithPath(path, absl::ResourceExhaustedError(kOutOfMemory));
}

absl::Status WriteTable(const UncertaintyTable& table, const fs::path& path, Existing existing) {
  return WriteTable(table.table(), path, existing);
}

}  // namespace albtpu
