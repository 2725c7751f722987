#include "generator/campaign/toml_reader.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "command_line/near_match.h"
#include "command_line/one_line.h"

namespace albtpu {

std::string FullName(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : std::string(table) + "." + std::string(key);
}

absl::StatusOr<TomlReader> TomlReader::Parse(std::string_view text) {
  try {
    return TomlReader(toml::parse(text));
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(absl::StrCat(
        "line ", error.source().begin.line, " is not TOML: ", OneLine(std::string(error.description()))));
  }
}

std::string TomlReader::Text(std::string_view table, std::string_view key,
                             std::optional<std::string_view> absent) {
  const std::string_view right = "a text in quotes";
  const toml::node* node = Find(table, key);
  if (node == nullptr) return absent ? std::string(*absent) : Missing<std::string>(table, key, right);
  const auto text = node->value_exact<std::string>();
  return text ? *text : Wrong<std::string>(*node, table, key, right);
}

double TomlReader::Number(std::string_view table, std::string_view key, double least, double most,
                          double absent) {
  const toml::node* node = Find(table, key);
  if (node == nullptr) return absent;
  const std::optional<double> number = node->value<double>();
  if (number && *number >= least && *number <= most) return *number;
  return Wrong<double>(*node, table, key, absl::StrCat("a number from ", least, " to ", most));
}

std::optional<std::int64_t> TomlReader::Integer(std::string_view table, std::string_view key,
                                                std::int64_t least, std::int64_t most) {
  const toml::node* node = Find(table, key);
  if (node == nullptr) return std::nullopt;
  const auto number = node->value_exact<std::int64_t>();
  if (number && *number >= least && *number <= most) return *number;
  return Wrong<std::int64_t>(*node, table, key, absl::StrCat("a whole number from ", least, " to ", most));
}

std::vector<double> TomlReader::Numbers(std::string_view table, std::string_view key) {
  const std::string_view right = "a list of numbers, such as [1, 2, 5]";
  const toml::node* node = Find(table, key);
  if (node == nullptr) return Missing<std::vector<double>>(table, key, right);
  const toml::array* array = node->as_array();
  if (array == nullptr) return Wrong<std::vector<double>>(*node, table, key, right);
  std::vector<double> numbers;
  for (const toml::node& element : *array) {
    const std::optional<double> number = element.value<double>();
    if (!number) return Wrong<std::vector<double>>(*node, table, key, right);
    numbers.push_back(*number);
  }
  return numbers;
}

void TomlReader::Fail(std::string_view problem) {
  if (error_.ok()) error_ = absl::InvalidArgumentError(std::string(problem));
}

absl::Status TomlReader::Finish() {
  CheckForUnknownKeys(root_, "");
  return error_;
}

const toml::node* TomlReader::Find(std::string_view table, std::string_view key) {
  known_.insert(FullName(table, key));
  if (table.empty()) return root_.get(key);
  const toml::table* inner = root_[table].as_table();
  return inner != nullptr ? inner->get(key) : nullptr;
}

template <typename T>
T TomlReader::Missing(std::string_view table, std::string_view key, std::string_view right) {
  something_is_missing_ = something_is_missing_ || error_.ok();
  Fail(absl::StrCat("'", FullName(table, key), "' is missing: give ", std::string(right)));
  return {};
}

template <typename T>
T TomlReader::Wrong(const toml::node& node, std::string_view table, std::string_view key,
                    std::string_view right) {
  Fail(absl::StrCat("'", FullName(table, key), "' in line ", node.source().begin.line, " must be ",
                    std::string(right)));
  return {};
}

void TomlReader::CheckForUnknownKeys(const toml::table& table, const std::string& prefix) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (prefix.empty() && node.is_table()) {
      CheckForUnknownKeys(*node.as_table(), name + ".");
    } else if (!known_.contains(name)) {
      const std::optional<std::string> near = NearestKnown(name);
      if (near && something_is_missing_) {
        error_ = absl::OkStatus();
        something_is_missing_ = false;
      }
      Fail(absl::StrCat("'", name, "' in line ", node.source().begin.line, " is not a key of a campaign; ",
                        near ? absl::StrCat("did you mean '", *near, "'?")
                             : absl::StrCat("there are ", absl::StrJoin(known_, ", "))));
    }
  }
}

// A key of the same name in another table, otherwise a near match.
std::optional<std::string> TomlReader::NearestKnown(const std::string& name) const {
  const auto own_name = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  for (const std::string& known : known_) {
    if (own_name(known) == own_name(name)) return known;
  }
  return NearMatch(name, std::vector<std::string>(known_.begin(), known_.end()));
}

}  // namespace albtpu
