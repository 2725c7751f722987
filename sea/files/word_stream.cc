#include "sea/files/word_stream.h"

namespace albtpu {

std::optional<std::string_view> WordStream::NextLine() {
  words_.clear();
  taken_ = 0;
  while (const auto line = lines_.Next())
    if (!Words(*line).empty()) return line;
  return std::nullopt;
}

absl::StatusOr<std::vector<double>> WordStream::Numbers(std::size_t count, std::string_view what) {
  std::vector<double> numbers;
  while (numbers.size() < count) {
    if (taken_ == words_.size()) {
      const auto line = lines_.Next();
      if (!line) return lines_.CutError();
      words_ = Words(*line);
      taken_ = 0;
      continue;
    }
    const std::string_view word = words_[taken_++];
    const auto number = ParseNumber(word);
    if (!number)
      return lines_.Error(Quoted(word), " is not ", std::string(what), "; get another copy of the file");
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace albtpu
