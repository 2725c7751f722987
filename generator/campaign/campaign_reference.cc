// The reference of campaign keys in Markdown, made of kCampaignKeys.
#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "generator/campaign/campaign_keys.h"

namespace albtpu {
namespace {

constexpr char kIntroduction[] = R"(# Campaign files

A campaign file states what a table holds and with what effort it is computed. It is a TOML file for `albtpu-generate
table` and `plan`. This page is the output of `albtpu-generate keys`, made from the list by which the program reads
and checks campaign files; do not edit it by hand.

```toml
id = "bay"
version = "1"
title = "A bay, light winds"

[axes]
wind_speed = [3, 5, 7]        # m/s
fetch = [1000, 10000, inf]    # m
incidence = [0, 10, 20]       # degree
azimuth = [0, 45, 90]         # degree from downwind
footprint = [0.25, 0.5, 1]    # m
depth = [0, 1, 20]            # m

[effort]
relative_error = 0.02
```

Nodes of an axis must increase; they are kept in single precision. Each unknown key is an error, and so is each value
out of its range.
)";

std::string Quoted(std::string_view text) { return absl::StrCat("`\"", std::string(text), "\"`"); }

std::string NumberText(double number) { return std::isinf(number) ? "`inf`" : absl::StrCat(number); }

struct TypeText {
  std::string operator()(const AnyText&) const { return "text"; }
  std::string operator()(const Choice&) const { return "text"; }
  std::string operator()(const NumberRange&) const { return "number"; }
  std::string operator()(const WholeRange&) const { return "whole number"; }
  std::string operator()(const NodeRange&) const { return "list of numbers"; }
};

struct RangeText {
  std::string operator()(const AnyText& text) const { return std::string(text.rule); }
  std::string operator()(const Choice& choice) const {
    return absl::StrJoin(choice.words, " or ",
                         [](std::string* joined, std::string_view word) { absl::StrAppend(joined, Quoted(word)); });
  }
  std::string operator()(const NumberRange& range) const {
    return absl::StrCat(NumberText(range.least), " to ", NumberText(range.most));
  }
  std::string operator()(const WholeRange& range) const { return absl::StrCat(range.least, " to ", range.most); }
  std::string operator()(const NodeRange& range) const {
    if (!std::isinf(range.most)) return absl::StrCat(NumberText(range.least), " to ", NumberText(range.most));
    return absl::StrCat(range.includes_least ? "at least " : "above ", NumberText(range.least));
  }
};

struct DefaultText {
  std::string operator()(const Required&) const { return "required"; }
  std::string operator()(const Derived& derived) const { return std::string(derived.rule); }
  std::string operator()(std::string_view text) const { return Quoted(text); }
  std::string operator()(double number) const { return NumberText(number); }
  std::string operator()(std::int64_t number) const { return absl::StrCat(number); }
};

using Row = std::array<std::string, 6>;

std::string MeaningText(const CampaignKey& key) {
  const auto* nodes = std::get_if<NodeRange>(&key.values);
  if (nodes == nullptr || nodes->why_most.empty()) return std::string(key.meaning);
  return absl::StrCat(std::string(key.meaning), " Not above ", nodes->most, ": ", std::string(nodes->why_most), ".");
}

Row RowOf(const CampaignKey& key) {
  return {absl::StrCat("`", std::string(key.name), "`"), std::visit(TypeText(), key.values),    std::string(key.unit),
          std::visit(RangeText(), key.values),           std::visit(DefaultText(), key.absent), MeaningText(key)};
}

// With columns that line up, but for the last one, whose texts are long.
std::string MarkdownTable(const std::vector<Row>& rows) {
  std::array<std::size_t, std::tuple_size_v<Row> - 1> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < widths.size(); ++i)
      absl::StrAppend(&text, "| ", rows[r][i], std::string(widths[i] - rows[r][i].size() + 1, ' '));
    absl::StrAppend(&text, "| ", rows[r].back(), " |\n");
    if (r > 0) continue;
    for (const std::size_t width : widths) absl::StrAppend(&text, "|", std::string(width + 2, '-'));
    absl::StrAppend(&text, "|---|\n");
  }
  return text;
}

constexpr char kOfWater[] = R"(
# Campaigns of the water column

With `kind = "water_column"`, a campaign has these keys beside `id`, `version`, `title` and `seed`. All lengths are over
the depth of the bottom; `generator/campaigns/water.toml` is the one that ships.
)";

void AppendTables(std::span<const CampaignKey> keys, std::string& page) {
  for (auto key = keys.begin(); key != keys.end();) {
    const std::string_view table = key->table;
    std::vector<Row> rows = {{"key", "type", "unit", "range", "default", "meaning"}};
    for (; key != keys.end() && key->table == table; ++key) rows.push_back(RowOf(*key));
    absl::StrAppend(&page, "\n## ", table.empty() ? "Top-level keys" : absl::StrCat("[", std::string(table), "]"),
                    "\n\n", MarkdownTable(rows));
  }
}

}  // namespace

std::string CampaignReference() {
  std::string page = kIntroduction;
  AppendTables(kCampaignKeys, page);
  page += kOfWater;
  AppendTables(kWaterCampaignKeys, page);
  return page;
}

}  // namespace albtpu
