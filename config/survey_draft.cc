#include "config/survey_draft.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "config/key_list.h"
#include "config/survey_settings.h"
#include "formats/text/text.h"

namespace albtpu::config {
namespace {

constexpr std::size_t kWidth = 100;  // Of prose, in columns.

// Lines "# ..." of at most kWidth columns.
std::string Prose(const std::string& text) {
  std::string lines, line = "#";
  for (const std::string& word : std::vector<std::string>(absl::StrSplit(text, ' '))) {
    if (line.size() > 1 && line.size() + 1 + word.size() > kWidth) {
      absl::StrAppend(&lines, line, "\n");
      line = "#";
    }
    absl::StrAppend(&line, " ", word);
  }
  return absl::StrCat(lines, line, "\n");
}

const ErrorSource* SourceOf(const ListedKey& key) {
  if (key.section != "sigma") return nullptr;
  return std::ranges::find(kErrorSources, key.key, &ErrorSource::name);
}

// "Wind speed at 10 m above the sea; 0 is a calm [m/s, 0 to 100; not given: ...]"
std::string Meaning(const ListedKey& key) {
  std::vector<std::string> facts;
  if (!key.values.unit.empty()) facts.push_back(key.values.unit);
  if (const std::string range = RangeText(key.values); !range.empty()) facts.push_back(range);
  std::string text = facts.empty() ? "" : absl::StrJoin(facts, ", ");
  if (!key.absent.empty()) absl::StrAppend(&text, text.empty() ? "" : "; ", "not given: ", key.absent);
  if (const ErrorSource* source = SourceOf(key); source != nullptr && !source->assumption.empty())
    absl::StrAppend(&text, ", ", std::string(source->assumption));
  return absl::StrCat(key.help, text.empty() ? "" : absl::StrCat(" [", text, "]"));
}

std::string Quoted(const std::string& text) { return absl::StrCat("\"", text, "\""); }

std::string List(const std::string& items) {
  return absl::StrCat("[", absl::StrJoin(std::vector<std::string>(absl::StrSplit(items, ',')), ", "), "]");
}

// The default of a key if it is a value; otherwise a word that it may have, or a placeholder.
std::string DefaultOrPlaceholder(const ListedKey& key) {
  const ValueFacts& values = key.values;
  if (const ErrorSource* source = SourceOf(key); source != nullptr) {
    const bool one = source->size() == 1;
    // The range to the surface is assumed to be as good as that to the bottom, whatever this is.
    if (source->assumption.empty() || source->Is(&AirErrors::surface_range)) return "NUMBER";
    const std::string numbers = absl::StrJoin(std::span(source->assumed).first(source->size()), ", ");
    return one ? numbers : absl::StrCat("[", numbers, "]");
  }
  if (!values.words.empty())
    return Quoted(std::ranges::count(values.words, key.absent) > 0 ? key.absent : values.words.front());
  if (values.type == "true or false") return "true";
  if (values.type == "number" || values.type == "number or path")
    return formats::ParseDouble(key.absent).has_value() ? key.absent : "NUMBER";
  if (values.type == "3 numbers" || values.type == "list of whole numbers") return List(values.shown);
  return values.type == "list of paths" ? absl::StrCat("[", Quoted(values.shown), "]") : Quoted(values.shown);
}

// A message with keys where it has their flags.
std::string WithKeys(std::string message) {
  std::vector<std::string> words = absl::StrSplit(message, ' ');
  for (std::string& word : words) {
    const std::size_t end = std::min(word.find_first_of(",;"), word.size());
    for (const ListedKey& key : ListKeys())
      if (!key.flag.empty() && word.substr(0, end) == key.flag) word = key.key + word.substr(end);
  }
  return absl::StrJoin(words, " ");
}

std::string Setting(bool counts, const std::string& key, const std::string& value, const std::string& why) {
  return absl::StrCat(counts ? "" : "#", key, " = ", value, why.empty() ? "" : "  # ", why, "\n");
}

}  // namespace

std::string DraftText(const SurveyDraft& draft) {
  std::string text, section;
  for (const std::string& line : draft.heading)
    absl::StrAppend(&text, line.empty() ? "#\n" : line.starts_with("  ") ? absl::StrCat("#", line, "\n") : Prose(line));
  for (const ListedKey& key : ListKeys()) {
    if (key.section != section) {
      section = key.section;
      // A table in a section holds only where it is wanted.
      const bool inner = section.find('.') != section.npos, many = IsOfMany(section);
      absl::StrAppend(&text, "\n", inner ? "#" : "", many ? "[[" : "[", section, many ? "]]" : "]", "\n");
      for (const OpenDecision& decision : draft.decisions)
        if (decision.section == section) absl::StrAppend(&text, Prose("DECIDE: " + WithKeys(decision.message)));
    }
    absl::StrAppend(&text, Prose(Meaning(key)));
    bool any = false;
    for (const DraftValue& value : draft.values) {
      if (value.section != key.section || value.key != key.key) continue;
      absl::StrAppend(&text, Setting(value.found, key.key, value.value, value.why));
      any = true;
    }
    if (!any) absl::StrAppend(&text, Setting(false, key.key, DefaultOrPlaceholder(key), ""));
  }
  return text;
}

std::vector<std::string> FlagOf(const DraftValue& value) {
  const std::vector<ListedKey> keys = ListKeys();
  const auto key = std::ranges::find_if(
      keys, [&](const ListedKey& each) { return each.section == value.section && each.key == value.key; });
  assert(key != keys.end() && !key->flag.empty());
  if (key->values.type == "true or false") return {key->flag};
  std::string text = value.value;
  std::erase_if(text, [](char letter) { return letter == '[' || letter == ']' || letter == '"' || letter == ' '; });
  return {key->flag, text};
}

}  // namespace albtpu::config
