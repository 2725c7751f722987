#include "formats/csv/csv_reader.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr std::size_t kBlockSize = 1 << 20;

// The end of the record at the beginning of a text.
struct RecordEnd {
  std::size_t text_size = 0;      // Without the line ending.
  std::size_t size = 0;           // With it.
  bool open = false;              // The text ends before the record does.
  bool open_quote = false;        // It ends inside a quoted cell.
  bool open_return = false;       // The text ends after a closing quote and a carriage return.
  bool text_after_quote = false;  // An error at offset `size`.
};

// Calls `cell_begins(offset)` for each cell except the first.
template <typename CellBegins>
RecordEnd FindRecordEnd(std::string_view text, std::size_t begin, char separator, CellBegins cell_begins) {
  enum class State { kCellStart, kPlain, kQuoted, kQuoteInQuoted, kReturnAfterQuote };
  State state = State::kCellStart;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char character = text[i];
    if (state == State::kQuoted) {
      if (character == '"') state = State::kQuoteInQuoted;
      continue;
    }
    if (character == '\n') {
      const bool carriage_return = i > begin && text[i - 1] == '\r';
      return {.text_size = i - carriage_return, .size = i + 1};
    }
    if (state == State::kReturnAfterQuote) return {.size = i, .text_after_quote = true};
    if (character == separator) {
      state = State::kCellStart;
      cell_begins(i + 1);
    } else if (state == State::kQuoteInQuoted) {
      if (character != '"' && character != '\r') return {.size = i, .text_after_quote = true};
      state = character == '"' ? State::kQuoted : State::kReturnAfterQuote;
    } else {
      state = state == State::kCellStart && character == '"' ? State::kQuoted : State::kPlain;
    }
  }
  return {.text_size = text.size(),
          .size = text.size(),
          .open = true,
          .open_quote = state == State::kQuoted,
          .open_return = state == State::kReturnAfterQuote};
}

std::size_t AfterByteOrderMark(std::string_view text, std::size_t line) {
  return line == 1 && text.substr(0, kByteOrderMark.size()) == kByteOrderMark ? kByteOrderMark.size() : 0;
}

// The size of the complete records at the beginning of a text. The whole text if a record is malformed: CsvRecords
// reports the error.
std::size_t SizeOfWholeRecords(std::string_view text, char separator) {
  if (text.find('"') == std::string_view::npos) return text.rfind('\n') + 1;
  for (std::size_t size = 0;;) {
    const RecordEnd end = FindRecordEnd(text.substr(size), 0, separator, [](std::size_t) {});
    if (end.text_after_quote) return text.size();
    if (end.open) return size;
    size += end.size;
  }
}

std::size_t CountLines(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

std::string_view CsvRecord::RawCell(std::size_t cell) const {
  const std::size_t begin = cell_begins[cell];
  const std::size_t end = cell + 1 < cell_begins.size() ? cell_begins[cell + 1] - 1 : text.size();
  return text.substr(begin, end - begin);
}

std::string CsvRecord::Cell(std::size_t cell) const {
  const std::string_view raw = RawCell(cell);
  if (raw.empty() || raw.front() != '"') return std::string(raw);
  std::string value;
  for (std::size_t i = 1; i + 1 < raw.size(); ++i) {
    value += raw[i];
    if (raw[i] == '"') ++i;  // A doubled quote stands for one.
  }
  return value;
}

absl::StatusOr<bool> CsvRecords::Next(CsvRecord& record) {
  if (rest_.empty()) return false;
  const std::size_t begin = AfterByteOrderMark(rest_, line_);
  record.line = line_;
  record.cell_begins.assign(1, begin);
  record.dialect = dialect_;
  const RecordEnd end =
      FindRecordEnd(rest_, begin, dialect_.separator, [&](std::size_t cell) { record.cell_begins.push_back(cell); });
  if (end.text_after_quote || end.open_return) {
    return absl::InvalidArgumentError(
        absl::StrCat(std::string(name_), " line ", line_ + CountLines(rest_.substr(0, end.size)), ", column ",
                     record.cell_count(), ": text follows a closing quote; double the quotes inside a quoted cell"));
  }
  if (end.open_quote || end.text_size > CsvReader::kLongestRecord) {
    return absl::InvalidArgumentError(absl::StrCat(std::string(name_), " line ", line_,
                                                   ": the record that begins here does not end; close its quote"));
  }
  record.text = rest_.substr(0, end.text_size);
  record.line_ending = rest_.substr(end.text_size, end.size - end.text_size);
  line_ += CountLines(rest_.substr(0, end.size));
  rest_.remove_prefix(end.size);
  return true;
}

absl::StatusOr<CsvDialect> DialectOf(std::string_view name, std::string_view text) {
  CsvDialect dialect;
  ASSIGN_OR_RETURN(dialect.separator, SeparatorOf(name, FirstRecordOf(text)));
  const RecordEnd end = FindRecordEnd(text, AfterByteOrderMark(text, 1), dialect.separator, [](std::size_t) {});
  const std::string_view header = text.substr(0, end.text_after_quote ? text.size() : end.size);
  ASSIGN_OR_RETURN(const std::optional<char> decimal,
                   DecimalOf(name, text.substr(header.size()), 1 + CountLines(header), dialect.separator));
  dialect.decimal = decimal.value_or('.');
  return dialect;
}

CsvReader::CsvReader(std::string name, std::FILE* file)
    : name_(std::move(name)), file_(file), stamp_(FileStamp::Of(fileno(file))) {}

absl::StatusOr<CsvReader> CsvReader::Open(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    const int error = errno;
    return absl::Status(absl::ErrnoToStatusCode(error),
                        absl::StrCat(path.string(), ": ", std::strerror(error), "; give a CSV file that can be read"));
  }
  CsvReader reader(path.string(), file);
  struct stat status;
  if (fstat(fileno(file), &status) == 0 && S_ISDIR(status.st_mode))
    return absl::FailedPreconditionError(absl::StrCat(path.string(), ": is a folder; give a CSV file"));
  return reader;
}

absl::StatusOr<std::size_t> CsvReader::Fill(std::size_t size) {
  const std::size_t before = rest_.size();
  if (stamp_.is_regular()) {
    // A short file needs no memory for a long one. Beyond its size is its end, or what was appended meanwhile.
    constexpr std::uint64_t kBeyond = 1 << 12;
    const std::uint64_t known = bytes_read_ + before;
    size = std::min<std::uint64_t>(size, file_size() > known ? file_size() - known : kBeyond);
  }
  rest_.resize(before + size);
  ssize_t count = 0;
  do count = read(fileno(file_.get()), rest_.data() + before, size);
  while (count < 0 && errno == EINTR);
  const int error = errno;
  rest_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (count < 0) {
    return absl::DataLossError(absl::StrCat(name_, ": reading failed at line ", line_ + CountLines(rest_), " (",
                                            std::strerror(error), "); copy the file to a sound disk"));
  }
  at_end_ = count == 0;
  return static_cast<std::size_t>(count);
}

void CsvReader::Take(std::size_t size, CsvBlock& block) {
  block.text.assign(rest_, 0, size);
  block.first_line = line_;
  block.dialect = dialect_;
  rest_.erase(0, size);
  line_ += CountLines(block.text);
  bytes_read_ += size;
}

absl::Status CsvReader::EndlessRecord() const {
  return absl::InvalidArgumentError(
      absl::StrCat(name_, " line ", line_, ": the record that begins here does not end; close its quote"));
}

absl::StatusOr<CsvBlock> CsvReader::ReadHeader() {
  RecordEnd end;
  do {
    if (rest_.size() > kLongestRecord) return EndlessRecord();
    if (const auto count = Fill(1 << 16); !count.ok()) return count.status();
    ASSIGN_OR_RETURN(dialect_.separator, SeparatorOf(name_, FirstRecordOf(rest_)));
    end = FindRecordEnd(rest_, AfterByteOrderMark(rest_, line_), dialect_.separator, [](std::size_t) {});
  } while (end.open && !at_end_);
  CsvBlock header;
  Take(end.text_after_quote ? rest_.size() : end.size, header);
  return header;
}

absl::StatusOr<bool> CsvReader::Read(CsvBlock& block) {
  std::size_t whole = 0;
  while (!at_end_ && whole == 0) {
    while (!at_end_ && rest_.size() < kBlockSize)
      if (const auto count = Fill(kBlockSize); !count.ok()) return count.status();
    whole = SizeOfWholeRecords(rest_, dialect_.separator);
    if (whole > 0 || at_end_) break;
    if (rest_.size() > kLongestRecord) return EndlessRecord();
    if (const auto count = Fill(kBlockSize); !count.ok()) return count.status();
  }
  Take(at_end_ ? rest_.size() : whole, block);
  if (!is_decimal_known_) {
    ASSIGN_OR_RETURN(const std::optional<char> decimal,
                     DecimalOf(name_, block.text, block.first_line, dialect_.separator));
    is_decimal_known_ = true;
    block.dialect.decimal = dialect_.decimal = decimal.value_or('.');
  }
  return !block.text.empty();
}

absl::Status CsvReader::CheckUnchanged() const {
  return stamp_.is_regular() ? stamp_.CheckUnchanged(name_, fileno(file_.get())) : absl::OkStatus();
}

}  // namespace albtpu::formats
