#include "config/toml/toml_keys.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/text/text.h"

namespace albtpu::config {
namespace {

namespace fs = std::filesystem;

// A hundred times what a survey needs. A longer text could nest keys so deeply ("a.a.a ...") that the TOML parser,
// which recurses into each level, would overflow the stack.
constexpr std::size_t kMostBytes = 32768;

absl::Status TooLong(std::uintmax_t bytes, const TomlKind& kind) {
  return absl::InvalidArgumentError(absl::StrCat("has ", bytes, " bytes (", std::string(kind.name), " has at most ",
                                                 kMostBytes, "); give the TOML that describes ",
                                                 std::string(kind.subject)));
}

}  // namespace

absl::StatusOr<toml::table> ParseToml(std::string_view text, const TomlKind& kind) {
  if (text.size() > kMostBytes) return TooLong(text.size(), kind);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(absl::StrCat("line ", error.source().begin.line, ": is not TOML (",
                                                   formats::OneLine(std::string(error.description())),
                                                   "); correct it"));
  }
}

absl::StatusOr<std::string> ReadTomlText(const fs::path& path, const TomlKind& kind) {
  std::error_code unknown;
  if (!fs::exists(path, unknown))
    return InFile(path, absl::NotFoundError(absl::StrCat("does not exist; check ", std::string(kind.given_by))));
  if (!fs::is_regular_file(path, unknown))
    return InFile(path, absl::FailedPreconditionError("is not a regular file; give a file of TOML"));
  const std::uintmax_t bytes = fs::file_size(path, unknown);
  if (!unknown && bytes > kMostBytes) return InFile(path, TooLong(bytes, kind));
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file && !file.eof()) return InFile(path, absl::UnavailableError("cannot be read; check its permissions"));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

absl::Status InFile(const fs::path& path, const absl::Status& problem) {
  return absl::Status(problem.code(), absl::StrCat(path.string(), ": ", problem.message()));
}

namespace {

// The shortest text of the number: 0.3, where toml++ writes 0.29999999999999999.
std::string FloatText(double number) {
  char text[32];
  const std::string shortest(text, std::to_chars(text, text + sizeof text, number).ptr);
  return shortest.find_first_of(".en") == std::string::npos ? shortest + ".0" : shortest;
}

// What stands in the file: short, and on one line.
std::string ValueText(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (node.is_floating_point()) return FloatText(*node.value<double>());
  std::ostringstream text;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << toml::toml_formatter(value);
  });
  constexpr std::size_t kLongest = 40;
  std::string value = std::move(text).str();
  return value.size() > kLongest ? value.substr(0, kLongest) + "..." : value;
}

std::optional<double> NumberOf(const toml::node& node) {
  return node.is_number() ? node.value<double>() : std::nullopt;
}

}  // namespace

std::string WordProblem(const std::string& text, const std::vector<std::string>& words) {
  if (std::ranges::find(words, text) != words.end()) return "";
  const std::optional<std::string> near = formats::NearMatch(text, words);
  return near.has_value() ? absl::StrCat("did you mean \"", *near, "\"?") : "give one of them";
}

std::string RangeOf(double least, double greatest, std::string_view unit) {
  return absl::StrCat(least, " to ", greatest, unit == "1" ? "" : " ", unit == "1" ? "" : std::string(unit));
}

void TomlProblem::Remember(const toml::source_region& source, const std::string& message) {
  if (!status_.ok()) return;
  status_ = absl::InvalidArgumentError(absl::StrCat("line ", source.begin.line, ": ", formats::OneLine(message)));
}

std::optional<double> TomlKeys::Number(std::string_view key, double least, double greatest, std::string_view unit) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<double> number = NumberOf(*node);
  if (number.has_value() && *number >= least && *number <= greatest) return number;
  Wrong(*node, key, RangeOf(least, greatest, unit),
        !number.has_value() ? absl::StrCat("give a number without quotes", unit == "1" ? "" : " and without its unit")
        : unit == "1"       ? "give a number in this range"
                            : absl::StrCat("give it in ", std::string(unit)));
  return std::nullopt;
}

std::optional<std::int64_t> TomlKeys::WholeNumber(std::string_view key, std::int64_t least, std::int64_t greatest) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<std::int64_t> number = node->value_exact<std::int64_t>();
  if (number.has_value() && *number >= least && *number <= greatest) return number;
  Wrong(*node, key, absl::StrCat("a whole number from ", least, " to ", greatest), "correct it");
  return std::nullopt;
}

std::optional<std::string> TomlKeys::Text(std::string_view key, std::string_view what) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const auto text = node->value_exact<std::string>();
  if (text.has_value() && !text->empty()) return text;
  Wrong(*node, key, std::string(what), "write it in quotes");
  return std::nullopt;
}

std::optional<std::string> TomlKeys::OneOf(std::string_view key, const std::vector<std::string>& words) {
  const std::optional<std::string> text = Text(key, absl::StrJoin(words, ", "));
  if (!text.has_value()) return std::nullopt;
  const std::string problem = WordProblem(*text, words);
  if (problem.empty()) return text;
  Wrong(*table_.get(key), key, absl::StrJoin(words, ", "), problem);
  return std::nullopt;
}

std::optional<bool> TomlKeys::Flag(std::string_view key) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<bool> flag = node->value_exact<bool>();
  if (!flag.has_value()) Wrong(*node, key, "true or false", "write it without quotes");
  return flag;
}

std::optional<std::array<double, 3>> TomlKeys::Triple(std::string_view key, double least, double greatest,
                                                      std::string_view unit, std::string_view parts) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const std::string expected = absl::StrCat("3 numbers from ", RangeOf(least, greatest, unit));
  const toml::array* const array = node->as_array();
  if (array == nullptr || array->size() != 3) {
    Wrong(*node, key, expected, absl::StrCat("give ", std::string(parts)));
    return std::nullopt;
  }
  std::array<double, 3> triple{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> number = NumberOf(*array->get(i));
    if (!number.has_value() || !(*number >= least && *number <= greatest)) {
      WrongElement(*array->get(i), key, expected);
      return std::nullopt;
    }
    triple[i] = *number;
  }
  return triple;
}

template <typename Element, typename Read>
std::vector<Element> TomlKeys::Elements(std::string_view key, const std::string& expected, const Read& read,
                                        bool may_repeat) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return {};
  const toml::array* const list = node->as_array();
  if (list == nullptr) {
    Wrong(*node, key, expected, "write a list in brackets");
    return {};
  }
  if (list->empty()) Fail(key, absl::StrCat("is empty (expected ", expected, "); name one or more, or leave it out"));
  std::vector<Element> elements;
  for (const toml::node& each : *list) {
    const std::optional<Element> element = read(each);
    if (!element.has_value()) {
      WrongElement(each, key, expected);
      return {};
    }
    if (!may_repeat && std::ranges::find(elements, *element) != elements.end())
      problem_.Remember(each.source(), absl::StrCat(Quoted(key), "has ", ValueText(each), " twice; name it once"));
    elements.push_back(*element);
  }
  return elements;
}

std::vector<double> TomlKeys::Numbers(std::string_view key) {
  return Elements<double>(key, "a list of numbers, such as [1, 2, 5]", NumberOf, true);
}

std::vector<int> TomlKeys::WholeNumbers(std::string_view key, int least, int greatest) {
  const auto read = [&](const toml::node& element) -> std::optional<int> {
    const std::optional<std::int64_t> number = element.value_exact<std::int64_t>();
    if (!number.has_value() || *number < least || *number > greatest) return std::nullopt;
    return static_cast<int>(*number);
  };
  return Elements<int>(key, absl::StrCat("whole numbers from ", least, " to ", greatest), read, false);
}

std::vector<std::string> TomlKeys::Texts(std::string_view key, std::string_view what) {
  const auto read = [](const toml::node& element) {
    std::optional<std::string> text = element.value_exact<std::string>();
    return text.has_value() && text->empty() ? std::nullopt : text;
  };
  return Elements<std::string>(key, absl::StrCat("texts, each ", std::string(what)), read, false);
}

std::vector<TomlKeys> TomlKeys::Table(std::string_view key) {
  const toml::node* const node = Find(key);
  std::vector<TomlKeys> tables;
  if (node == nullptr) return tables;
  const std::string name = NameOf(key);
  if (const toml::table* const table = node->as_table())
    tables.emplace_back(*table, name, problem_);
  else
    Wrong(*node, key, "a table", absl::StrCat("begin it with [", name, "]"));
  return tables;
}

std::vector<TomlKeys> TomlKeys::Tables(std::string_view key) {
  const toml::node* const node = Find(key);
  std::vector<TomlKeys> tables;
  if (node == nullptr) return tables;
  const std::string name = NameOf(key);
  const toml::array* const array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous<toml::table>()) {
    Wrong(*node, key, "tables", absl::StrCat("begin each of them with [[", name, "]]"));
    return tables;
  }
  for (const toml::node& element : *array) tables.emplace_back(*element.as_table(), name, problem_);
  return tables;
}

void TomlKeys::Finish() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, node] : table_) {
    if (known_.contains(key.str())) continue;
    const std::string name(key.str());
    problem_.Remember(
        key.source(),
        absl::StrCat(Quoted(name), "is no key of ", problem_.kind(),
                     formats::Suggestion(name, known, absl::StrCat("there are ", absl::StrJoin(known, ", ")))));
  }
}

const toml::node* TomlKeys::Find(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

std::string TomlKeys::NameOf(std::string_view key) const {
  return absl::StrCat(name_.empty() ? "" : name_ + ".", std::string(key));
}

std::string TomlKeys::Quoted(std::string_view key) const {
  if (key.empty()) return absl::StrCat("[", name_, "] ");
  return absl::StrCat("'", NameOf(key), "' ");
}

void TomlKeys::WrongElement(const toml::node& element, std::string_view key, const std::string& expected) {
  problem_.Remember(element.source(),
                    absl::StrCat(Quoted(key), "has ", ValueText(element), " (expected ", expected, "); correct it"));
}

void TomlKeys::Wrong(const toml::node& node, std::string_view key, const std::string& expected,
                     const std::string& remedy) {
  problem_.Remember(node.source(),
                    absl::StrCat(Quoted(key), "is ", ValueText(node), " (expected ", expected, "); ", remedy));
}

}  // namespace albtpu::config
