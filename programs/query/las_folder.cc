#include "programs/query/las_folder.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace albtpu::programs {
namespace {

// Numbers of a note, and the words around them.
struct Parts {
  std::vector<std::string> words = {""}, numbers;
};

Parts PartsOf(const std::string& note) {
  Parts parts;
  for (std::size_t i = 0; i < note.size();) {
    const auto is_digit = [&](std::size_t at) {
      return at < note.size() && std::isdigit(static_cast<unsigned char>(note[at])) != 0;
    };
    // A digit within a word is none: "S-44 1b" differs from "2".
    const bool in_word = i > 0 && (std::isalnum(static_cast<unsigned char>(note[i - 1])) != 0 || note[i - 1] == '_');
    std::size_t end = i + (note[i] == '-' && is_digit(i + 1) ? 1 : 0);
    if (in_word || !is_digit(end)) {
      parts.words.back() += note[i++];
      continue;
    }
    while (is_digit(end) || (end < note.size() && note[end] == '.' && is_digit(end + 1))) ++end;
    parts.numbers.push_back(note.substr(i, end - i));
    parts.words.emplace_back();
    i = end;
  }
  return parts;
}

double ValueOf(const std::string& number) { return std::strtod(number.c_str(), nullptr); }

}  // namespace

void NotesOfFiles::Add(const std::string& file, const std::vector<std::string>& notes) {
  ++files_;
  for (const std::string& text : notes) {
    const Parts parts = PartsOf(text);
    const auto found = std::ranges::find(notes_, parts.words, &Note::words);
    if (found == notes_.end()) {
      notes_.push_back({parts.words, parts.numbers, parts.numbers, {file}});
      continue;
    }
    for (std::size_t i = 0; i < parts.numbers.size(); ++i) {
      if (ValueOf(parts.numbers[i]) < ValueOf(found->least[i])) found->least[i] = parts.numbers[i];
      if (ValueOf(parts.numbers[i]) > ValueOf(found->greatest[i])) found->greatest[i] = parts.numbers[i];
    }
    found->files.push_back(file);
  }
}

std::vector<std::string> NotesOfFiles::Lines() const {
  std::vector<std::string> lines;
  for (const Note& note : notes_) {
    std::string line = note.words.front();
    for (std::size_t i = 0; i < note.least.size(); ++i) {
      const bool one = note.least[i] == note.greatest[i];
      absl::StrAppend(&line, note.least[i], one ? "" : absl::StrCat("..", note.greatest[i]), note.words[i + 1]);
    }
    if (note.files.size() < files_) {
      absl::StrAppend(&line, " (", note.files.front(),
                      note.files.size() > 1 ? absl::StrCat(" and ", note.files.size() - 1, " more files") : "", ")");
    }
    lines.push_back(line);
  }
  return lines;
}

void LasFolder::Add(const std::string& file, const annotate::AnnotatedLas& annotated) {
  ++files_;
  totals_.Merge(annotated.totals);
  dry_.Merge(annotated.dry);
  notes_.Add(file, annotated.notes);
}

std::string LasFolder::LineOf(const annotate::AnnotatedLas& annotated, S44Order order) {
  const std::uint64_t with_total = annotated.totals.count();
  std::string text = absl::StrFormat(" %d points, %d bathymetric, %d of them with a total", annotated.classes.points(),
                                     annotated.summary.outcomes().total(), with_total);
  if (with_total > 0)
    absl::StrAppendFormat(&text, "; %s; order %s at %.1f %%", annotated.totals.Medians(), std::string(Name(order)),
                          100 * static_cast<double>(annotated.totals.meeting(order)) / static_cast<double>(with_total));
  return text;
}

std::string LasFolder::Text(Coverage coverage, S44Order order, const std::vector<std::string>& assumed) const {
  std::string text = totals_.count() > 0 ? totals_.Text(coverage, order) : "";
  if (dry_.count() > 0) absl::StrAppend(&text, "\n  ", dry_.Text(coverage));
  for (const std::vector<std::string>& lines : {assumed, notes_.Lines()})
    for (const std::string& line : lines) absl::StrAppend(&text, "\n  ", line);
  return text;
}

}  // namespace albtpu::programs
