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

  // The rest of the line in which words were last taken is dropped. Blank lines are passed over. nullopt at the end.
  std::optional<std::string_view> NextLine();

  // The next `count` numbers, which may go on over lines. `what` is for messages: "a frequency".
  absl::StatusOr<std::vector<double>> Numbers(std::size_t count, std::string_view what);

  const TextLines& lines() const { return lines_; }

 private:
  TextLines lines_;
  std::vector<std::string_view> words_;  // of the last line
  std::size_t taken_ = 0;                // of these words
};

}  // namespace albtpu
