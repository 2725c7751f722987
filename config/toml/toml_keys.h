// Files of TOML, and the keys of their tables read one by one. The first problem is remembered with its line, so that
// code that reads many keys checks once.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu::config {

// A file of TOML as text and as a table, with one message for what is wrong with it.

// How messages speak of a kind of file.
struct TomlKind {
  std::string_view name;      // "a survey file"
  std::string_view subject;   // what it describes: "the survey"
  std::string_view given_by;  // what names it: "the path of --survey"
};

// InvalidArgument "line 3: is not TOML ..." or "has 40000 bytes ...".
absl::StatusOr<toml::table> ParseToml(std::string_view text, const TomlKind& kind);

// The text of a file. Fails, as ParseToml does, for one that is too long.
absl::StatusOr<std::string> ReadTomlText(const std::filesystem::path& path, const TomlKind& kind);

// A problem of the text, with the path of its file before it.
absl::Status InFile(const std::filesystem::path& path, const absl::Status& problem);

// The first problem of a file, "line 3: 'sea.tail' is ...".
class TomlProblem {
 public:
  explicit TomlProblem(const TomlKind& kind) : kind_(kind.name) {}

  void Remember(const toml::source_region& source, const std::string& message);
  const absl::Status& status() const { return status_; }
  const std::string& kind() const { return kind_; }  // "a survey file"

 private:
  std::string kind_;
  absl::Status status_;
};

// Empty if `text` is one of `words`; otherwise what to do: "did you mean ...?", "give one of them".
std::string WordProblem(const std::string& text, const std::vector<std::string>& words);

// "0 to 30 m"; `unit` is "1" where there is none.
std::string RangeOf(double least, double greatest, std::string_view unit);

class TomlKeys {
 public:
  // `name` is the table's in messages, "sea.waves"; empty for the root. The arguments must outlive it.
  TomlKeys(const toml::table& table, std::string name, TomlProblem& problem)
      : table_(table), name_(std::move(name)), problem_(problem) {}

  // Absent if the key is missing or a problem.
  std::optional<double> Number(std::string_view key, double least, double greatest, std::string_view unit);
  std::optional<std::int64_t> WholeNumber(std::string_view key, std::int64_t least, std::int64_t greatest);
  std::optional<std::string> Text(std::string_view key, std::string_view what);
  std::optional<std::string> OneOf(std::string_view key, const std::vector<std::string>& words);
  std::optional<bool> Flag(std::string_view key);

  // Three numbers, which are `parts`: "[north, east, down]".
  std::optional<std::array<double, 3>> Triple(std::string_view key, double least, double greatest,
                                              std::string_view unit, std::string_view parts);

  // Lists, each element once. Empty if the key is missing or a problem; an empty list is a problem. `what` is what an
  // element is: "the path of a file".
  std::vector<double> Numbers(std::string_view key);  // May have a number twice.
  std::vector<int> WholeNumbers(std::string_view key, int least, int greatest);
  std::vector<std::string> Texts(std::string_view key, std::string_view what);

  // The tables under `[name.key]`, one at most, and under `[[name.key]]`.
  std::vector<TomlKeys> Table(std::string_view key);
  std::vector<TomlKeys> Tables(std::string_view key);

  bool Has(std::string_view key) const { return table_.contains(key); }
  bool IsText(std::string_view key) const { return Has(key) && table_.get(key)->is_string(); }

  // A problem of this table as a whole, and one of a key that it has.
  void Fail(const std::string& message) { problem_.Remember(table_.source(), Quoted("") + message); }
  void Fail(std::string_view key, const std::string& message) {
    problem_.Remember(table_.get(key)->source(), Quoted(key) + message);
  }

  // The last call: a key that was not asked for is a problem.
  void Finish();

 private:
  const toml::node* Find(std::string_view key);
  std::string NameOf(std::string_view key) const;  // "sea.tail"; of the root "tail"
  std::string Quoted(std::string_view key) const;  // "'sea.tail' "; of the table itself "[sea] "
  void Wrong(const toml::node& node, std::string_view key, const std::string& expected, const std::string& remedy);
  template <typename Element, typename Read>
  std::vector<Element> Elements(std::string_view key, const std::string& expected, const Read& read, bool may_repeat);
  void WrongElement(const toml::node& element, std::string_view key, const std::string& expected);

  const toml::table& table_;
  std::string name_;
  TomlProblem& problem_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace albtpu::config
