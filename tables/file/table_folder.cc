#include "tables/file/table_folder.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "status/status_macros.h"
#include "tables/file/table_io.h"

namespace albtpu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPreferredName = "survey";

// With the text around them, these are less than the kilobyte at which the service cuts messages, which travel in
// HTTP headers.
constexpr std::size_t kMaxListedBytes = 800;
constexpr std::size_t kMaxQuotedBytes = 100;

bool IsName(std::string_view text) {
  return !text.empty() && absl::ascii_isalnum(text[0]) && std::all_of(text.begin(), text.end(), [](char c) {
    return absl::ascii_isalnum(c) || c == '.' || c == '_' || c == '-';
  });
}

// The name of the table or version by the name of a file; nullopt for other files.
std::optional<std::string> TableStem(const fs::path& path) {
  std::string stem = path.stem().string();
  if (path.extension() != ".h5" || !IsName(stem)) return std::nullopt;
  return stem;
}

absl::StatusOr<std::vector<fs::directory_entry>> List(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::directory_entry> entries;
  fs::directory_iterator it(folder, error);
  for (; !error && it != fs::directory_iterator(); it.increment(error)) entries.push_back(*it);
  if (error == std::errc::no_such_file_or_directory)
    return absl::NotFoundError(absl::StrCat("there is no folder '", folder.string(), "'"));
  if (error) return absl::ErrnoToStatus(error.value(), absl::StrCat("cannot read folder '", folder.string(), "'"));
  return entries;
}

absl::StatusOr<std::vector<TableFile>> FindVersions(const fs::path& folder) {
  ASSIGN_OR_RETURN(const std::vector<fs::directory_entry> entries, List(folder));
  std::vector<TableFile> files;
  for (const fs::directory_entry& entry : entries) {
    std::error_code ignored;
    const std::optional<std::string> version = TableStem(entry.path());
    if (!version.has_value() || entry.is_directory(ignored)) continue;
    files.push_back({folder.filename().string(), *version, entry.path()});
  }
  return files;
}

// Removes a run of digits, or a run of other characters, from the front of `text`.
std::string_view TakeRun(std::string_view& text) {
  const bool digits = absl::ascii_isdigit(text[0]);
  const auto end = std::find_if(text.begin(), text.end(), [&](char c) { return absl::ascii_isdigit(c) != digits; });
  const std::string_view run = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(run.size());
  return run;
}

int CompareNumbers(std::string_view a, std::string_view b) {
  a.remove_prefix(std::min(a.find_first_not_of('0'), a.size()));
  b.remove_prefix(std::min(b.find_first_not_of('0'), b.size()));
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

std::string Quoted(std::string_view text) {
  const bool cut = text.size() > kMaxQuotedBytes;
  const std::string escaped = absl::CHexEscape(std::string(text.substr(0, kMaxQuotedBytes)));
  return absl::StrCat("'", escaped, cut ? "...'" : "'");
}

std::string ListNames(std::span<const TableFile> tables) {
  std::string names;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (names.size() > kMaxListedBytes) return absl::StrCat(names, " and ", tables.size() - i, " more");
    absl::StrAppend(&names, i == 0 ? "" : ", ", tables[i].FullName());
  }
  return names.empty() ? "none" : names;
}

// The newest version of the only name among the tables for which `counts` holds; nullopt if there are several names or
// none.
template <typename Predicate>
std::optional<std::size_t> OnlyName(std::span<const TableFile> tables, Predicate counts) {
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (!counts(tables[i])) continue;
    if (!only.has_value()) only = i;
    if (tables[*only].name != tables[i].name) return std::nullopt;
  }
  return only;
}

bool IsMeant(const TableFile& table, std::string_view request) {
  return table.name == request || table.FullName() == request;
}

}  // namespace

std::string TableFile::FullName() const { return version.empty() ? name : absl::StrCat(name, "/", version); }

absl::StatusOr<std::vector<TableFile>> FindTables(const fs::path& folder) {
  ASSIGN_OR_RETURN(const std::vector<fs::directory_entry> entries, List(folder));
  std::vector<TableFile> files;
  for (const fs::directory_entry& entry : entries) {
    std::error_code ignored;
    if (entry.is_directory(ignored)) {
      if (!IsName(entry.path().filename().string())) continue;
      ASSIGN_OR_RETURN(std::vector<TableFile> versions, FindVersions(entry.path()));
      std::move(versions.begin(), versions.end(), std::back_inserter(files));
    } else if (const std::optional<std::string> name = TableStem(entry.path()); name.has_value()) {
      files.push_back({*name, "", entry.path()});
    }
  }
  std::sort(files.begin(), files.end(), [](const TableFile& a, const TableFile& b) {
    return a.name != b.name ? a.name < b.name : IsOlder(b.version, a.version);
  });
  // The empty version is the oldest one and so the last of its name.
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].name != files[i - 1].name || !files[i].version.empty()) continue;
    return absl::InvalidArgumentError(absl::StrCat("'", files[i].path.string(), "' and '", files[i - 1].path.string(),
                                                   "' are both table '", files[i].name,
                                                   "': move one of them into the folder of the other, or rename it"));
  }
  return files;
}

std::string DigestsText(const fs::path& folder) {
  const absl::StatusOr<std::vector<TableFile>> files = FindTables(folder);
  if (!files.ok()) return absl::StrCat("no tables: ", files.status().message());
  std::string text;
  for (const TableFile& file : *files) {
    const absl::StatusOr<UncertaintyTable> table = ReadTable(file.path);
    absl::StrAppend(&text, text.empty() ? "" : "\n", "table ", file.FullName(), " ",
                    table.ok() ? table->digest() : std::string(table.status().message()));
  }
  return text.empty() ? absl::StrCat("no tables: no .h5 file in ", folder.string()) : text;
}

bool IsOlder(std::string_view version, std::string_view other) {
  std::string_view a = version, b = other;
  while (!a.empty() && !b.empty()) {
    const bool numbers = absl::ascii_isdigit(a[0]) && absl::ascii_isdigit(b[0]);
    const std::string_view run_a = TakeRun(a), run_b = TakeRun(b);
    const int order = numbers ? CompareNumbers(run_a, run_b) : run_a.compare(run_b);
    if (order != 0) return order < 0;
  }
  if (a.empty() != b.empty()) return a.empty();
  return version < other;  // They differ at most in leading zeros.
}

absl::StatusOr<std::size_t> FindTable(std::span<const TableFile> tables, std::string_view request,
                                      std::string_view default_table) {
  if (request.empty()) request = default_table;
  const bool default_is_meant = request.empty();
  if (default_is_meant) request = kPreferredName;
  const auto found =
      std::find_if(tables.begin(), tables.end(), [&](const TableFile& table) { return IsMeant(table, request); });
  if (found != tables.end()) return static_cast<std::size_t>(found - tables.begin());
  if (!default_is_meant)
    return absl::NotFoundError(absl::StrCat("there is no table ", Quoted(request), ": there are ", ListNames(tables)));
  std::optional<std::size_t> only = OnlyName(tables, [](const TableFile&) { return true; });
  if (!only.has_value()) only = OnlyName(tables, [](const TableFile& table) { return !table.published; });
  if (only.has_value()) return *only;
  return absl::FailedPreconditionError(
      absl::StrCat("no table is named and there is no default table: name one of ", ListNames(tables)));
}

}  // namespace albtpu
