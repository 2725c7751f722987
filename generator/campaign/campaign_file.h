// Reads the keys of a TOML file one by one and remembers the first problem, so that code that reads many keys needs to
// check for errors only once.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu {

// "axes.depth": the name of a key in messages; the table is empty for keys at the top level.
std::string FullName(std::string_view table, std::string_view key);

// Keys are named by their table ("" for the root) and their own name. A key that is missing, of another type or out of
// range yields an empty value; `Finish` then returns an error with the key, its line and the values that it takes.
class TomlReader {
 public:
  // InvalidArgument with the line if `text` is not TOML.
  static absl::StatusOr<TomlReader> Parse(std::string_view text);

  bool Has(std::string_view table, std::string_view key) { return Find(table, key) != nullptr; }

  // A text; `absent` if the key is missing, which is a problem without an `absent`.
  std::string Text(std::string_view table, std::string_view key,
                   std::optional<std::string_view> absent = std::nullopt);

  // A number in [least, most]; `absent` if the key is missing.
  double Number(std::string_view table, std::string_view key, double least, double most, double absent);

  // A whole number in [least, most]; nothing if the key is missing.
  std::optional<std::int64_t> Integer(std::string_view table, std::string_view key, std::int64_t least,
                                      std::int64_t most);

  // A list of numbers; it is a problem if the key is missing.
  std::vector<double> Numbers(std::string_view table, std::string_view key);

  // Remembers a problem that the caller found.
  void Fail(std::string_view problem);

  // The first problem, otherwise a key that was not read. Such a key comes first if a key is missing of which it may be
  // a misspelling.
  absl::Status Finish();

 private:
  explicit TomlReader(toml::table root) : root_(std::move(root)) {}

  const toml::node* Find(std::string_view table, std::string_view key);
  template <typename T>
  T Missing(std::string_view table, std::string_view key, std::string_view right);
  template <typename T>
  T Wrong(const toml::node& node, std::string_view table, std::string_view key, std::string_view right);
  void CheckForUnknownKeys(const toml::table& table, const std::string& prefix);
  std::optional<std::string> NearestKnown(const std::string& name) const;

  toml::table root_;
  std::set<std::string> known_;        // the keys that were read
  absl::Status error_;                 // the first problem
  bool something_is_missing_ = false;  // that is the first problem
};

}  // namespace albtpu
