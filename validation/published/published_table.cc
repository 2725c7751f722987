#include "validation/published/published_table.h"

#include <charconv>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"

namespace albtpu {

absl::StatusOr<PublishedTable> PublishedTable::Read(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return absl::NotFoundError(absl::StrCat(file.string(), ": cannot be read"));
  PublishedTable table;
  table.file_ = file;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const absl::string_view content = absl::StripAsciiWhitespace(text);
    if (content.empty() || content.front() == '#') continue;
    std::vector<std::string> cells = absl::StrSplit(content, ',');
    if (table.columns_.empty()) {
      table.columns_ = std::move(cells);
    } else if (cells.size() == table.columns_.size()) {
      table.rows_.push_back({line, std::move(cells)});
    } else {
      return absl::InvalidArgumentError(absl::StrCat(file.string(), ": line ", line, " has ", cells.size(),
                                                     " cells: there are ", table.columns_.size(), " columns"));
    }
  }
  if (table.rows_.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(file.string(), ": has no rows: expected a line of column names and at least one row"));
  }
  return table;
}

absl::StatusOr<std::size_t> PublishedTable::Find(std::string_view column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i] == column) return i;
  return absl::InvalidArgumentError(absl::StrCat(file_.string(), ": no column '", std::string(column), "': there are ",
                                                 absl::StrJoin(columns_, ", ")));
}

absl::StatusOr<std::vector<std::string>> PublishedTable::Words(std::string_view column) const {
  const absl::StatusOr<std::size_t> index = Find(column);
  if (!index.ok()) return index.status();
  std::vector<std::string> words;
  for (const Row& row : rows_) words.push_back(row.cells[*index]);
  return words;
}

absl::StatusOr<std::vector<double>> PublishedTable::Numbers(std::string_view column) const {
  const absl::StatusOr<std::size_t> index = Find(column);
  if (!index.ok()) return index.status();
  std::vector<double> numbers;
  for (const Row& row : rows_) {
    const std::string& cell = row.cells[*index];
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      return absl::InvalidArgumentError(absl::StrCat(file_.string(), ": line ", row.line, ", column '",
                                                     std::string(column), "': '", cell, "' is not a number"));
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace albtpu
