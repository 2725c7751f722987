#include "validation/report/study.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace albtpu {
namespace {

std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  return absl::StrCat("\"", absl::StrReplaceAll(text, {{"\"", "\"\""}}), "\"");
}

std::string CellText(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return Quoted(*text);
  const double number = std::get<double>(cell);
  return std::isnan(number) ? "" : absl::StrFormat("%.9g", number);
}

}  // namespace

std::string CsvOf(const DataTable& table) {
  std::string csv;
  const auto append = [&csv](const auto& cells, const auto& text) {
    for (std::size_t i = 0; i < cells.size(); ++i) absl::StrAppend(&csv, i == 0 ? "" : ",", text(cells[i]));
    csv += '\n';
  };
  append(table.columns, Quoted);
  for (const std::vector<Cell>& row : table.rows) append(row, CellText);
  return csv;
}

std::string_view Name(Verdict verdict) {
  constexpr std::string_view kNames[] = {"agrees", "differs", "reported"};
  return kNames[static_cast<std::size_t>(verdict)];
}

int Count(const std::vector<Study>& studies, Verdict verdict) {
  int count = 0;
  for (const Study& study : studies)
    for (const Comparison& comparison : study.comparisons) count += comparison.verdict == verdict;
  return count;
}

DataTable SummaryOf(const std::vector<Study>& studies) {
  DataTable summary{
      "summary",
      "Every comparison with its verdict",
      {"study", "quantity", "unit", "published", "ours", "standard_error", "difference", "verdict", "basis"}};
  for (const Study& study : studies) {
    for (const Comparison& c : study.comparisons) {
      summary.Add(study.id, c.quantity, c.unit, c.published, c.ours, c.standard_error, c.ours - c.published,
                  Name(c.verdict), c.basis);
    }
  }
  return summary;
}

}  // namespace albtpu
