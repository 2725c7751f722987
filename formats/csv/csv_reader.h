// Reads a CSV file (RFC 4180): first its header, then blocks of complete records; and splits a block into records that
// keep their original bytes.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/csv/csv_dialect.h"
#include "formats/files/file_access.h"

namespace albtpu::formats {

// A record as written in the file; it refers to the text of its block. A quoted cell may span several lines.
struct CsvRecord {
  std::string_view text;                 // Including quotes, without the line ending.
  std::string_view line_ending;          // "\n", "\r\n", or empty at the end of a file.
  std::size_t line = 0;                  // Of its first character, counted from 1.
  std::vector<std::size_t> cell_begins;  // Offsets into `text`.
  CsvDialect dialect;

  std::size_t cell_count() const { return cell_begins.size(); }
  std::string_view RawCell(std::size_t cell) const;  // As written, with quotes.
  std::string Cell(std::size_t cell) const;          // The value, without quotes.
  bool blank() const { return text.empty(); }
};

// Complete records, and their position in the file.
struct CsvBlock {
  std::string text;
  std::size_t first_line = 1;
  CsvDialect dialect = {};
};

// The byte order mark with which some programs begin UTF-8 files.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Iterates over the records of a block, which must outlive it. `name` is the file, for messages. A byte order mark is
// part of the text of the first record, but not of its first cell.
class CsvRecords {
 public:
  CsvRecords(std::string_view name, const CsvBlock& block)
      : name_(name), rest_(block.text), line_(block.first_line), dialect_(block.dialect) {}

  // Reads the next record into `record` and reuses its memory. False at the end of the block.
  absl::StatusOr<bool> Next(CsvRecord& record);

 private:
  std::string_view name_;
  std::string_view rest_;
  std::size_t line_;
  CsvDialect dialect_;
};

// The separator and the decimal mark of a whole text, as CsvReader finds them in a file. Without fractions, a decimal
// point.
absl::StatusOr<CsvDialect> DialectOf(std::string_view name, std::string_view text);

class CsvReader {
 public:
  // Bytes. A longer record is reported as a quote that was never closed.
  static constexpr std::size_t kLongestRecord = 1 << 20;

  static absl::StatusOr<CsvReader> Open(const std::filesystem::path& path);

  // The first record alone, as soon as it has arrived: through a pipe the next one may come much later. Empty if the
  // file is empty. Its dialect has the separator.
  absl::StatusOr<CsvBlock> ReadHeader();

  // Reads the next records into `block` and reuses its memory. False at the end of the file. The first of
  // them, a megabyte, show the decimal mark of the file.
  absl::StatusOr<bool> Read(CsvBlock& block);

  const std::string& name() const { return name_; }
  // As far as it was read.
  const CsvDialect& dialect() const { return dialect_; }
  std::uint64_t bytes_read() const { return bytes_read_; }
  std::uint64_t file_size() const { return stamp_.size(); }  // 0 for a pipe.

  // Fails when the file has been modified since it was opened.
  absl::Status CheckUnchanged() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  CsvReader(std::string name, std::FILE* file);
  absl::StatusOr<std::size_t> Fill(std::size_t size);  // Appends at most `size` bytes to `rest_`.
  void Take(std::size_t size, CsvBlock& block);        // Moves `size` bytes from `rest_`.
  absl::Status EndlessRecord() const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  FileStamp stamp_;
  std::string rest_;  // Bytes read but not yet returned.
  bool at_end_ = false;
  CsvDialect dialect_;
  bool is_decimal_known_ = false;
  std::size_t line_ = 1;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace albtpu::formats
