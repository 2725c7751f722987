// The draft of a survey file: all keys of the tables with their units, ranges and defaults as comments, and values for
// those of which something is known. ParseSurvey reads what it writes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace albtpu::config {

// What a survey leaves open, and nothing may stand for.
struct OpenDecision {
  std::string section;  // Of the survey file, that would say it; words of its own where only flags do: "beam size".
  std::string message;  // "PROBLEM; REMEDY"
};

// The value of one key, which must be in a table, as TOML: `"riegl-vq-880-g"`, `[41, 42]`.
struct DraftValue {
  std::string section, key, value;
  std::string why = {};  // Where it is from; may be empty.
  bool found = false;    // It counts. Otherwise it is one that may be chosen, behind a `#`.
};

struct SurveyDraft {
  std::vector<std::string> heading = {};  // Lines at the beginning; indented ones stay as they are, others are wrapped.
  std::vector<OpenDecision> decisions = {};
  std::vector<DraftValue> values = {};  // Of one key several, if they may be chosen from.
};

// A line "# ..." is prose, and "#key = value" is a setting that does not count until its # is removed. Its value is the
// default or an example; in capitals it is a placeholder: NUMBER.
std::string DraftText(const SurveyDraft& draft);

// The flag of a key and its value: {"--water-classes", "41,42"}, {"--trajectory-from-returns"}. The key must have
// a flag.
std::vector<std::string> FlagOf(const DraftValue& value);

}  // namespace albtpu::config
