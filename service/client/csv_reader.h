// Records of a CSV file (RFC 4180), one at a time, with the bytes they were written in.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::client {

// A record as it stands in the file. A quoted cell may span lines.
struct CsvRecord {
  std::string text;         // All of it, quotes included, without the line ending.
  std::string line_ending;  // "\n", "\r\n", or nothing at the end of a file.
  std::size_t line = 0;     // Of its first character, from 1.

  std::size_t cell_count() const { return cell_begins.size(); }
  std::string_view RawCell(std::size_t cell) const;  // As written, with its quotes.
  std::string Cell(std::size_t cell) const;          // As meant, without them.
  bool blank() const { return text.empty(); }

  std::vector<std::size_t> cell_begins;  // Offsets into `text`.
};

// The byte order mark that some programs put in front of UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class CsvReader {
 public:
  // A record longer than this is taken for a quote that was never closed.
  static constexpr std::size_t kLongestRecord = 1 << 20;

  static absl::StatusOr<CsvReader> Open(const std::filesystem::path& path);

  // Reads the next record into `record`, reusing its memory. False at the end of the file. A byte order mark
  // stays part of the first record's text, and not of its first cell.
  absl::StatusOr<bool> Read(CsvRecord& record);

  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  CsvReader(std::string name, std::FILE* file);
  int NextByte();  // EOF at the end.

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t line_ = 1;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace albtpu::client
