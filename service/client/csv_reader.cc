#include "service/client/csv_reader.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace albtpu::client {

std::string_view CsvRecord::RawCell(std::size_t cell) const {
  const std::size_t begin = cell_begins[cell];
  const std::size_t end = cell + 1 < cell_begins.size() ? cell_begins[cell + 1] - 1 : text.size();
  return std::string_view(text).substr(begin, end - begin);
}

std::string CsvRecord::Cell(std::size_t cell) const {
  const std::string_view raw = RawCell(cell);
  if (raw.empty() || raw.front() != '"') return std::string(raw);
  std::string meant;
  for (std::size_t i = 1; i + 1 < raw.size(); ++i) {
    meant += raw[i];
    if (raw[i] == '"') ++i;  // A doubled quote is one.
  }
  return meant;
}

CsvReader::CsvReader(std::string name, std::FILE* file) : name_(std::move(name)), file_(file) {}

absl::StatusOr<CsvReader> CsvReader::Open(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    const int error = errno;
    return absl::Status(
        absl::ErrnoToStatusCode(error),
        absl::StrCat(path.string(), ": ", std::strerror(error), ": name a CSV file that can be read"));
  }
  CsvReader reader(path.string(), file);
  struct stat status;
  if (fstat(fileno(file), &status) == 0 && S_ISDIR(status.st_mode)) {
    return absl::FailedPreconditionError(absl::StrCat(path.string(), ": is a folder: name a CSV file"));
  }
  return reader;
}

int CsvReader::NextByte() {
  const int byte = getc_unlocked(file_.get());
  if (byte != EOF) ++bytes_read_;
  return byte;
}

absl::StatusOr<bool> CsvReader::Read(CsvRecord& record) {
  enum class State { kCellStart, kPlain, kQuoted, kQuoteInQuoted };

  const bool first_record = bytes_read_ == 0;
  record.text.clear();
  record.line_ending.clear();
  record.line = line_;
  record.cell_begins.assign(1, 0);
  State state = State::kCellStart;
  for (int byte = NextByte();; byte = NextByte()) {
    if (byte == EOF) {
      if (std::ferror(file_.get())) {
        return absl::DataLossError(absl::StrCat(name_, ": reading failed at line ", line_, ": ",
                                                std::strerror(errno), ": copy the file to a sound disk"));
      }
      if (state == State::kQuoted) break;
      return !record.text.empty();
    }
    const char character = static_cast<char>(byte);
    if (character == '\n') ++line_;
    if (character == '\n' && state != State::kQuoted) {
      const bool carriage_return = !record.text.empty() && record.text.back() == '\r';
      if (carriage_return) record.text.pop_back();
      record.line_ending = carriage_return ? "\r\n" : "\n";
      return true;
    }
    record.text += character;
    if (record.text.size() > kLongestRecord) break;
    if (first_record && record.text == kByteOrderMark) {
      record.cell_begins[0] = kByteOrderMark.size();
      state = State::kCellStart;
      continue;
    }
    switch (state) {
      case State::kQuoted:
        if (character == '"') state = State::kQuoteInQuoted;
        continue;
      case State::kQuoteInQuoted:
        if (character == '"') {
          state = State::kQuoted;
          continue;
        }
        if (character != ',' && character != '\r') {
          return absl::InvalidArgumentError(absl::StrCat(name_, " line ", line_, ", column ",
                                                         record.cell_count(),
                                                         ": text follows a closing quote: double the quotes "
                                                         "inside a quoted cell"));
        }
        break;
      case State::kCellStart:
        if (character == '"') {
          state = State::kQuoted;
          continue;
        }
        break;
      case State::kPlain:
        break;
    }
    state = character == ',' ? State::kCellStart : State::kPlain;
    if (character == ',') record.cell_begins.push_back(record.text.size());
  }
  return absl::InvalidArgumentError(absl::StrCat(
      name_, " line ", record.line, ": the record that begins here does not end: close its quote"));
}

}  // namespace albtpu::client
