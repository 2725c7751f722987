// The tables of a campaign file, key by key. The first problem is remembered with its line.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "config/toml/toml_keys.h"

namespace albtpu {

// "axes.depth": the name of a key in messages; the table is empty for keys at the top level.
std::string FullName(std::string_view table, std::string_view key);

inline constexpr config::TomlKind kCampaignFile = {"a campaign file", "the campaign", "the path of --campaign"};

class CampaignFile {
 public:
  explicit CampaignFile(const toml::table& root) : problem_(kCampaignFile), root_(root, "", problem_) {}
  CampaignFile(const CampaignFile&) = delete;

  // The keys of a table, "" for those at the top level; of one that the file does not have, an empty table.
  config::TomlKeys& operator[](std::string_view table);

  // Remembers that a key is missing. `right` is what to give: "a list of numbers".
  void Miss(std::string_view table, std::string_view key, std::string_view right);

  // The first problem, otherwise a key that was not asked for, which may be a missing one, misspelt; otherwise what is
  // missing.
  absl::Status Finish();

 private:
  const toml::table none_;
  config::TomlProblem problem_;
  config::TomlKeys root_;
  std::map<std::string, config::TomlKeys, std::less<>> tables_;
  std::string missing_;
};

}  // namespace albtpu
