// A CSV file (RFC 4180) as its header and blocks of whole records, and the records of a block with the bytes
// they were written in.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "survey/files/file_stamp.h"

namespace albtpu::client {

// A record as it stands in the file, whose text it refers to. A quoted cell may span lines.
struct CsvRecord {
  std::string_view text;                 // All of it, quotes included, without the line ending.
  std::string_view line_ending;          // "\n", "\r\n", or nothing at the end of a file.
  std::size_t line = 0;                  // Of its first character, from 1.
  std::vector<std::size_t> cell_begins;  // Offsets into `text`.

  std::size_t cell_count() const { return cell_begins.size(); }
  std::string_view RawCell(std::size_t cell) const;  // As written, with its quotes.
  std::string Cell(std::size_t cell) const;          // As meant, without them.
  bool blank() const { return text.empty(); }
};

// Whole records, and where they stand in the file.
struct CsvBlock {
  std::string text;
  std::size_t first_line = 1;
};

// The byte order mark that some programs put in front of UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The records of a block, one after the other. `name` is the file, for messages; the block must outlive it. A
// byte order mark stays part of the first record's text, and not of its first cell.
class CsvRecords {
 public:
  CsvRecords(std::string_view name, const CsvBlock& block)
      : name_(name), rest_(block.text), line_(block.first_line) {}

  // Reads the next record into `record`, reusing its memory. False at the end of the block.
  absl::StatusOr<bool> Next(CsvRecord& record);

 private:
  std::string_view name_;
  std::string_view rest_;
  std::size_t line_;
};

class CsvReader {
 public:
  // A record longer than this is taken for a quote that was never closed.
  static constexpr std::size_t kLongestRecord = 1 << 20;

  static absl::StatusOr<CsvReader> Open(const std::filesystem::path& path);

  // The first record alone, as soon as it is there: a pipe may take its time with the next. Nothing when the
  // file is empty.
  absl::StatusOr<CsvBlock> ReadHeader();

  // Many records, reusing the memory of `block`. False at the end of the file.
  absl::StatusOr<bool> Read(CsvBlock& block);

  const std::string& name() const { return name_; }
  std::uint64_t bytes_read() const { return bytes_read_; }
  std::uint64_t file_size() const { return stamp_.size(); }  // 0 when it is a pipe.

  // Fails when somebody wrote to the file since it was opened.
  absl::Status CheckUnchanged() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  CsvReader(std::string name, std::FILE* file);
  absl::StatusOr<std::size_t> Fill(std::size_t size);  // Appends up to so many bytes to `rest_`.
  void Take(std::size_t size, CsvBlock& block);        // Moves bytes from `rest_`.
  absl::Status EndlessRecord() const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  FileStamp stamp_;
  std::string rest_;  // Read and not given out.
  bool at_end_ = false;
  std::size_t line_ = 1;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace albtpu::client
