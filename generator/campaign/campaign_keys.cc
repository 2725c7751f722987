#include "generator/campaign/campaign_keys.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace albtpu {

std::string ReadText(TomlReader& toml, const CampaignKey& key) {
  const auto* absent = std::get_if<std::string_view>(&key.absent);
  const bool may_be_absent = !std::holds_alternative<Required>(key.absent);
  const std::string text = toml.Text(
      key.table, key.name,
      may_be_absent ? std::optional<std::string_view>(absent != nullptr ? *absent : "") : std::nullopt);
  if (const auto* choice = std::get_if<Choice>(&key.values)) {
    if (std::find(choice->words.begin(), choice->words.end(), text) == choice->words.end()) {
      const std::string words =
          absl::StrJoin(choice->words, " or ", [](std::string* joined, std::string_view word) {
            absl::StrAppend(joined, "\"", std::string(word), "\"");
          });
      toml.Fail(absl::StrCat("'", FullName(key), "' must be ", words));
    }
  }
  return text;
}

std::optional<double> ReadNumber(TomlReader& toml, const CampaignKey& key) {
  const auto& range = std::get<NumberRange>(key.values);
  const double number = toml.Number(key.table, key.name, range.least, range.most, std::nan(""));
  if (!std::isnan(number)) return number;
  const auto* absent = std::get_if<double>(&key.absent);
  return absent != nullptr ? std::optional<double>(*absent) : std::nullopt;
}

std::optional<std::int64_t> ReadWhole(TomlReader& toml, const CampaignKey& key) {
  const auto& range = std::get<WholeRange>(key.values);
  const std::optional<std::int64_t> number = toml.Integer(key.table, key.name, range.least, range.most);
  if (number) return number;
  const auto* absent = std::get_if<std::int64_t>(&key.absent);
  return absent != nullptr ? std::optional<std::int64_t>(*absent) : std::nullopt;
}

std::vector<double> ReadNodes(TomlReader& toml, const CampaignKey& key) {
  return toml.Numbers(key.table, key.name);
}

std::string NodesProblem(const CampaignKey& key, const std::vector<double>& nodes) {
  const auto& range = std::get<NodeRange>(key.values);
  if (nodes.empty()) return absl::StrCat("'", FullName(key), "' has no node: give at least one");
  if (range.includes_least ? nodes.front() < range.least : nodes.front() <= range.least) {
    return absl::StrCat("node 0 of '", FullName(key), "' must be ",
                        range.includes_least ? "at least " : "above ", range.least);
  }
  if (nodes.back() > range.most) {
    return absl::StrCat("the last node of '", FullName(key), "' is above ", range.most, " ",
                        std::string(key.unit), " (", std::string(range.why_most), "); leave it out");
  }
  return {};
}

}  // namespace albtpu
