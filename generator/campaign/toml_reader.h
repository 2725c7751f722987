// Reads the keys of a TOML file one by one and remembers the first thing that is wrong, so that a reader of
// many keys stays a list of keys.
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

// Keys are named by the table they stand in ("" for the root) and their own name. A key that is missing, of
// another type or out of its range yields an empty value; `Finish` then says which, in which line, and what
// would be right.
class TomlReader {
 public:
  // InvalidArgument with the line when `text` is not TOML.
  static absl::StatusOr<TomlReader> Parse(std::string_view text);

  // A text; `absent` where the key is missing, which is wrong if there is no `absent`.
  std::string Text(std::string_view table, std::string_view key,
                   std::optional<std::string_view> absent = std::nullopt);

  // A number in [least, most]; `absent` where the key is missing.
  double Number(std::string_view table, std::string_view key, double least, double most, double absent);

  // A whole number in [least, most]; nothing where the key is missing.
  std::optional<std::int64_t> Integer(std::string_view table, std::string_view key, std::int64_t least,
                                      std::int64_t most);

  // A list of numbers, which must not be missing.
  std::vector<double> Numbers(std::string_view table, std::string_view key);

  // Remembers a problem that the caller saw.
  void Fail(std::string_view problem);

  // The first problem, or else a key that nobody asked for.
  absl::Status Finish();

 private:
  explicit TomlReader(toml::table root) : root_(std::move(root)) {}

  const toml::node* Find(std::string_view table, std::string_view key);
  template <typename T>
  T Missing(std::string_view table, std::string_view key, std::string_view right);
  template <typename T>
  T Wrong(const toml::node& node, std::string_view table, std::string_view key, std::string_view right);
  void CheckForUnknownKeys(const toml::table& table, const std::string& prefix);

  toml::table root_;
  std::set<std::string> known_;
  absl::Status error_;
};

}  // namespace albtpu
