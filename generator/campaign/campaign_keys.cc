#include "generator/campaign/campaign_keys.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace albtpu {

std::string ReadText(CampaignFile& file, const CampaignKey& key) {
  const auto* const choice = std::get_if<Choice>(&key.values);
  std::optional<std::string> text;
  if (choice != nullptr)
    text = file[key.table].OneOf(key.name, {choice->words.begin(), choice->words.end()});
  else
    text = file[key.table].Text(key.name, std::get<AnyText>(key.values).rule);
  if (text.has_value()) return *text;
  if (std::holds_alternative<Required>(key.absent) && !file[key.table].Has(key.name))
    file.Miss(key.table, key.name, "a text in quotes");
  const auto* const absent = std::get_if<std::string_view>(&key.absent);
  return absent != nullptr ? std::string(*absent) : "";
}

std::optional<double> ReadNumber(CampaignFile& file, const CampaignKey& key) {
  const auto& range = std::get<NumberRange>(key.values);
  const std::optional<double> number =
      file[key.table].Number(key.name, range.least, range.most, key.unit.empty() ? "1" : key.unit);
  const auto* const absent = std::get_if<double>(&key.absent);
  return number.has_value() || absent == nullptr ? number : *absent;
}

std::optional<std::int64_t> ReadWhole(CampaignFile& file, const CampaignKey& key) {
  const auto& range = std::get<WholeRange>(key.values);
  const std::optional<std::int64_t> number = file[key.table].WholeNumber(key.name, range.least, range.most);
  const auto* const absent = std::get_if<std::int64_t>(&key.absent);
  return number.has_value() || absent == nullptr ? number : *absent;
}

std::vector<double> ReadNodes(CampaignFile& file, const CampaignKey& key) {
  if (!file[key.table].Has(key.name)) file.Miss(key.table, key.name, "a list of numbers, such as [1, 2, 5]");
  return file[key.table].Numbers(key.name);
}

std::string NodesProblem(const CampaignKey& key, const std::vector<double>& nodes) {
  const auto& range = std::get<NodeRange>(key.values);
  const auto wrong = std::ranges::find_if(nodes, [](double node) { return std::isnan(node); });
  if (wrong != nodes.end())
    return absl::StrCat("node ", wrong - nodes.begin(), " of '", FullName(key), "' is not a number; correct it");
  if (range.includes_least ? nodes.front() < range.least : nodes.front() <= range.least) {
    return absl::StrCat("node 0 of '", FullName(key), "' must be ", range.includes_least ? "at least " : "above ",
                        range.least);
  }
  if (nodes.back() > range.most) {
    return absl::StrCat("the last node of '", FullName(key), "' is above ", range.most, " ", std::string(key.unit),
                        " (", std::string(range.why_most), "); leave it out");
  }
  return {};
}

}  // namespace albtpu
