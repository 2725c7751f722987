// The words of a text one after the other, where numbers may stand on any number of lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "sea/files/text_lines.h"

namespace albtpu {

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
