// A reader of the paper's tables as CSV files: lines of attribution that begin with `#`, a line of column names, rows
// of numbers and words.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

class PublishedTable {
 public:
  // NotFound if there is no such file; InvalidArgument, with file and line, if a row does not match the column names.
  static absl::StatusOr<PublishedTable> Read(const std::filesystem::path& file);

  std::size_t size() const { return rows_.size(); }  // rows

  // InvalidArgument, with file, line and column, if there is no such column or if a number is expected and a word
  // found.
  absl::StatusOr<std::vector<double>> Numbers(std::string_view column) const;
  absl::StatusOr<std::vector<std::string>> Words(std::string_view column) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };

  absl::StatusOr<std::size_t> Find(std::string_view column) const;

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

}  // namespace albtpu
