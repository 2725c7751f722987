// The lines and the words of a text in memory, and the numbers and times in them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"

namespace albtpu {

class TextLines {
 public:
  // The treatment of a last line without a line feed, with which texts of fixed columns often end.
  enum class LastLine {
    kIsCut,
    kMayEndAtColumn,  // whole if a word of the line before ends at the same column
  };

  explicit TextLines(std::string_view text, LastLine last_line = LastLine::kIsCut)
      : rest_(text), last_line_(last_line) {}

  // The next line without its end; nullopt after the last one. A last line that was cut is not returned, and cut() is
  // true from then on.
  std::optional<std::string_view> Next();

  std::size_t number() const { return number_; }  // of the line that Next() gave, from 1
  bool cut() const { return cut_; }

  // "line 7: " before the parts.
  template <typename... Parts>
  absl::Status Error(const Parts&... parts) const {
    return absl::InvalidArgumentError(absl::StrCat("line ", number_, ": ", parts...));
  }

  // The error of a text that ends too early.
  absl::Status CutError() const;

 private:
  bool IsWhole(std::string_view last) const;

  std::string_view rest_, before_;
  LastLine last_line_;
  std::size_t number_ = 0;
  bool cut_ = false;
};

// The words of a line, separated by blanks and tabs.
std::vector<std::string_view> Words(std::string_view line);

// A finite decimal number. The E may be missing before an exponent of three digits, as Fortran writes it:
// "0.261-104".
std::optional<double> ParseNumber(std::string_view word);

// A whole number of digits alone.
std::optional<int> ParseCount(std::string_view word);

// SecondsOf() (sea/sea_time.h) of eight digits of a date and six of a time of day, as WAVEWATCH III and SWAN write
// them.
std::optional<double> SecondsOfDigits(std::string_view date, std::string_view time_of_day);

// A word of the file in quotes for messages, shortened and printable.
std::string Quoted(std::string_view word);

// The words of a text one after the other, where numbers may stand on any number of lines.

class WordStream {
 public:
  explicit WordStream(std::string_view text) : lines_(text, TextLines::LastLine::kMayEndAtColumn) {}

  // The next line that is not blank; nullopt at the end. Drops the rest of a line of which Numbers() took words.
  std::optional<std::string_view> NextLine();

  // The next `count` numbers, on any number of lines. `what` names one in messages: "a frequency".
  absl::StatusOr<std::vector<double>> Numbers(std::size_t count, std::string_view what);

  const TextLines& lines() const { return lines_; }

 private:
  TextLines lines_;
  std::vector<std::string_view> words_;  // of the last line
  std::size_t taken_ = 0;                // of these words
};

}  // namespace albtpu
