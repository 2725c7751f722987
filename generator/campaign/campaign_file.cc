#include "generator/campaign/campaign_file.h"

#include <vector>

#include "absl/strings/str_cat.h"

namespace albtpu {

std::string FullName(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : std::string(table) + "." + std::string(key);
}

config::TomlKeys& CampaignFile::operator[](std::string_view table) {
  if (table.empty()) return root_;
  const auto known = tables_.find(table);
  if (known != tables_.end()) return known->second;
  std::vector<config::TomlKeys> given = root_.Table(table);
  if (given.empty()) given.emplace_back(none_, std::string(table), problem_);
  return tables_.emplace(table, given.front()).first->second;
}

void CampaignFile::Miss(std::string_view table, std::string_view key, std::string_view right) {
  if (missing_.empty()) missing_ = absl::StrCat("'", FullName(table, key), "' is missing; give ", std::string(right));
}

absl::Status CampaignFile::Finish() {
  for (auto& [name, keys] : tables_) keys.Finish();
  root_.Finish();
  if (!problem_.status().ok() || missing_.empty()) return problem_.status();
  return absl::InvalidArgumentError(missing_);
}

}  // namespace albtpu
