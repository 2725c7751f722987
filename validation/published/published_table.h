// The paper's tables as CSV files: `#` lines of attribution, a line of column names, numbers and words.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

class PublishedTable {
 public:
  // NotFound: no such file. InvalidArgument, naming file and line: rows that do not fit the column names.
  static absl::StatusOr<PublishedTable> Read(const std::filesystem::path& file);

  std::size_t size() const { return rows_.size(); }  // rows

  // InvalidArgument, naming file, line and column: no such column, or a word where a number should be.
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
