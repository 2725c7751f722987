#include "config/key.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"

namespace albtpu::config {
namespace {

namespace fs = std::filesystem;
using formats::ParseDouble;

std::vector<std::string> Texts(const Word& word) { return {word.words.begin(), word.words.end()}; }

template <typename Read>
Value ValueOf(const std::optional<Read>& read) {
  return read.has_value() ? Value(*read) : Value();
}

Value InFolder(const fs::path& folder, const std::optional<std::string>& path) {
  return path.has_value() ? Value((folder / *path).string()) : Value();
}

// Reads the value of one key.
struct Reader {
  TomlKeys& keys;
  std::string_view key;
  const fs::path& folder;

  Value operator()(const Number& range) { return ValueOf(keys.Number(key, range.least, range.greatest, range.unit)); }
  Value operator()(const ThreeNumbers& range) {
    return ValueOf(keys.Triple(key, range.least, range.greatest, range.unit, range.parts));
  }
  Value operator()(const Word& word) { return ValueOf(keys.OneOf(key, Texts(word))); }
  Value operator()(const Text& text) { return ValueOf(keys.Text(key, text.what)); }
  Value operator()(const Path& path) { return InFolder(folder, keys.Text(key, path.what)); }
  Value operator()(const Paths&) {
    std::vector<std::string> paths = keys.Texts(key, "the path of a file or folder");
    for (std::string& path : paths) path = (folder / path).string();
    return paths;
  }
  Value operator()(const NumberOrPath& either) {
    if (keys.IsText(key)) return InFolder(folder, keys.Text(key, either.what));
    return (*this)(either.number);
  }
  Value operator()(const WholeNumbers& range) { return keys.WholeNumbers(key, range.least, range.greatest); }
  Value operator()(const YesOrNo&) { return ValueOf(keys.Flag(key)); }
};

// Reads the text of one flag.
struct Parser {
  std::string_view text;

  absl::Status Wrong(const std::string& expected, const std::string& remedy) const {
    return absl::InvalidArgumentError(absl::StrCat("is '", std::string(text), "' (expected ", expected, "); ", remedy));
  }

  absl::StatusOr<Value> operator()(const Number& range) const {
    const std::optional<double> number = ParseDouble(text);
    if (number.has_value() && *number >= range.least && *number <= range.greatest) return *number;
    return Wrong(RangeOf(range.least, range.greatest, range.unit), "give a number in this range");
  }
  absl::StatusOr<Value> operator()(const ThreeNumbers& range) const {
    const std::vector<std::string> items = absl::StrSplit(absl::string_view(text.data(), text.size()), ',');
    Triple triple{};
    bool good = items.size() == triple.size();
    for (std::size_t i = 0; good && i < triple.size(); ++i) {
      triple[i] = ParseDouble(items[i]).value_or(NAN);
      good = triple[i] >= range.least && triple[i] <= range.greatest;
    }
    if (good) return triple;
    return Wrong(
        absl::StrCat("3 numbers from ", RangeOf(range.least, range.greatest, range.unit)),
        absl::StrCat("give ", std::string(range.parts.substr(1, range.parts.size() - 2)), " with commas between them"));
  }
  absl::StatusOr<Value> operator()(const Word& word) const {
    const std::vector<std::string> words = Texts(word);
    const std::string problem = WordProblem(std::string(text), words);
    if (problem.empty()) return std::string(text);
    return Wrong(absl::StrJoin(words, ", "), problem);
  }
  absl::StatusOr<Value> operator()(const Text& some) const {
    if (!text.empty()) return std::string(text);
    return Wrong(std::string(some.what), "write it after the flag");
  }
  absl::StatusOr<Value> operator()(const Path& path) const { return (*this)(Text{path.what, path.shown}); }
  absl::StatusOr<Value> operator()(const Paths&) const {
    if (!text.empty()) return std::vector<std::string>{std::string(text)};
    return Wrong("the path of a file or folder", "write it after the flag");
  }
  absl::StatusOr<Value> operator()(const NumberOrPath& either) const {
    if (text.empty()) return Wrong(std::string(either.what), "write it after the flag");
    return ParseDouble(text).has_value() ? (*this)(either.number) : Value(std::string(text));
  }
  absl::StatusOr<Value> operator()(const WholeNumbers& range) const {
    std::vector<int> numbers;
    for (const std::string& item :
         std::vector<std::string>(absl::StrSplit(absl::string_view(text.data(), text.size()), ','))) {
      int number = 0;
      const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), number);
      if (error != std::errc() || end != item.data() + item.size() || number < range.least || number > range.greatest)
        return Wrong(absl::StrCat("whole numbers from ", range.least, " to ", range.greatest),
                     "separate them by commas");
      numbers.push_back(number);
    }
    return numbers;
  }
  absl::StatusOr<Value> operator()(const YesOrNo&) const { return true; }
};

}  // namespace

Value ReadValue(TomlKeys& keys, const KeyDeclaration& key, const fs::path& folder) {
  return std::visit(Reader{keys, key.key, folder}, key.values);
}

absl::StatusOr<Value> ParseValue(const KeyDeclaration& key, std::string_view text) {
  return std::visit(Parser{text}, key.values);
}

std::string RangeText(const Number& range) {
  return absl::StrCat("a number from ", RangeOf(range.least, range.greatest, range.unit));
}

}  // namespace albtpu::config
