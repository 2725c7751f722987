#include "validation/report/report.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "tables/file/output_folder.h"

namespace albtpu {
namespace {

constexpr const char* kPage = "report.html";

absl::Status WriteFile(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())) || !out.flush())
    return absl::DataLossError(absl::StrCat(file.string(), ": cannot be written: ", std::strerror(errno)));
  return absl::OkStatus();
}

std::string Contents(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

absl::Status WriteTables(const std::vector<Study>& studies, const std::filesystem::path& folder) {
  std::vector<DataTable> tables = {SummaryOf(studies)};
  for (const Study& study : studies) tables.insert(tables.end(), study.tables.begin(), study.tables.end());
  for (const DataTable& table : tables)
    if (const auto status = WriteFile(folder / (table.name + ".csv"), CsvOf(table)); !status.ok()) return status;
  return absl::OkStatus();
}

// Every file, the page last.
std::vector<std::string> NamesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename() != kPage) names.push_back(entry.path().filename());
  names.emplace_back(kPage);
  return names;
}

}  // namespace

absl::StatusOr<std::string> WriteReport(const std::vector<Study>& studies, const ReportOptions& options) {
  const HiddenFolder hidden(options.folder);
  const std::filesystem::path& folder = hidden.path();
  if (folder.empty()) return NotWritable(options.folder);
  if (const auto status = WriteTables(studies, folder); !status.ok()) return status;

  std::vector<std::string> figures;
  for (const Study& study : studies)
    for (const FigureRequest& figure : study.figures) figures.push_back(figure.name);
  // draw.py draws from the CSV files in its first folder into its second. A figure that cannot be drawn is left out.
  std::vector<std::string> drawing = {(options.plots / "draw.py").string(), folder.string(), folder.string()};
  drawing.insert(drawing.end(), figures.begin(), figures.end());
  const absl::Status drawn = figures.empty() ? absl::OkStatus() : RunPython(drawing);
  ReportPage page{options.made_by, {}, std::string(drawn.message())};
  for (const std::string& figure : figures) {
    const std::filesystem::path svg = folder / (figure + ".svg");
    if (std::filesystem::exists(svg)) {
      page.figures[figure] = Contents(svg);
    } else {  // a figure of an earlier report would not match the new numbers
      std::error_code ignored;
      std::filesystem::remove(options.folder / svg.filename(), ignored);
    }
  }
  if (const auto status = WriteFile(folder / kPage, HtmlOf(studies, page)); !status.ok()) return status;
  if (const auto status = hidden.Publish(NamesIn(folder)); !status.ok()) return status;
  return page.why_figures_are_missing;
}

namespace {

// Wide tables scroll sideways by themselves; on a narrow screen each line of the summary becomes a card.
constexpr const char* kStyle = R"(
:root { --ink: #1b2a38; --faint: #5c6b78; --line: #d5dde3; --sea: #0b6280; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 1rem; color: var(--ink); background: #fff;
       font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.2; }
h2 { margin-top: 3rem; border-top: 2px solid var(--sea); padding-top: .6rem; }
h1, h2, a { color: var(--sea); } p, figcaption { max-width: 46rem; } figure { margin: 1.5rem 0; }
figure img { width: 100%; max-width: 46rem; height: auto; }
figcaption, .made-by { color: var(--faint); font-size: .9rem; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th, td { padding: .25rem .6rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
td.number { text-align: right; white-space: nowrap; }
.quantity::first-letter { text-transform: uppercase; } tr.study th { padding-top: 1.2rem; font-size: 1rem; }
.agrees { color: #14692f; } .differs { color: #a32014; font-weight: 600; } .reported { color: var(--faint); }
@media (max-width: 48rem) {
  .summary thead { display: none; } .summary, .summary tbody, .summary tr, .summary td, .summary th { display: block; }
  .summary tr { border: 1px solid var(--line); border-radius: .4rem; margin: .6rem 0; padding: .3rem .5rem; }
  .summary td, .summary td.number { border: 0; text-align: left; padding: .05rem .2rem; white-space: normal; }
  .summary tr.study { border: 0; padding: 0; } .summary td:empty { display: none; }
  .summary td::before { content: attr(data-label) ": "; color: var(--faint); }
  .summary td.quantity { font-weight: 600; } .summary td.quantity::before { content: none; }
}
)";

std::string Escaped(absl::string_view text) {
  return absl::StrReplaceAll(text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}});
}

// Four significant digits, more than any published number has.
std::string NumberText(double number) { return std::isnan(number) ? "" : absl::StrFormat("%.4g", number); }

std::string CellHtml(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return absl::StrCat("<td>", Escaped(*text), "</td>");
  return absl::StrCat("<td class=\"number\">", NumberText(std::get<double>(cell)), "</td>");
}

std::string TableHtml(const DataTable& table) {
  if (!table.on_the_page) {
    return absl::StrCat("<p>", Escaped(table.title), ": ", table.rows.size(), " lines in <code>", table.name,
                        ".csv</code>.</p>\n");
  }
  std::string html = absl::StrCat("<div class=\"scroll\"><table><caption>", Escaped(table.title), " (<code>",
                                  table.name, ".csv</code>)</caption><thead><tr>");
  for (const std::string& column : table.columns) absl::StrAppend(&html, "<th>", Escaped(column), "</th>");
  html += "</tr></thead><tbody>\n";
  for (const std::vector<Cell>& row : table.rows) {
    html += "<tr>";
    for (const Cell& cell : row) html += CellHtml(cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string SummaryHtml(const std::vector<Study>& studies) {
  std::string html =
      "<table class=\"summary\"><thead><tr><th>quantity</th><th>unit</th><th>published</th><th>ours</th>"
      "<th>standard error</th><th>difference</th><th>verdict</th><th>basis</th></tr></thead>\n<tbody>\n";
  for (const Study& study : studies) {
    if (study.comparisons.empty()) continue;
    absl::StrAppend(&html, "<tr class=\"study\"><th colspan=\"8\"><a href=\"#", study.id, "\">", Escaped(study.title),
                    "</a></th></tr>\n");
    for (const Comparison& c : study.comparisons) {
      const auto number = [](const char* label, double value) {
        return absl::StrCat("<td class=\"number\" data-label=\"", label, "\">", NumberText(value), "</td>");
      };
      const std::string verdict(Name(c.verdict));
      absl::StrAppend(&html, "<tr><td class=\"quantity\">", Escaped(c.quantity), "</td><td data-label=\"unit\">",
                      Escaped(c.unit), "</td>");
      absl::StrAppend(&html, number("published", c.published), number("ours", c.ours),
                      number("standard error", c.standard_error), number("difference", c.ours - c.published));
      absl::StrAppend(&html, "<td data-label=\"verdict\" class=\"", verdict, "\">", verdict,
                      "</td><td data-label=\"basis\">", Escaped(c.basis), "</td></tr>\n");
    }
  }
  return html + "</tbody></table>\n";
}

std::string CountsHtml(const std::vector<Study>& studies) {
  return absl::StrCat("<p>Of the comparisons below, ", Count(studies, Verdict::kAgrees), " agree, ",
                      Count(studies, Verdict::kDiffers), " differ and ", Count(studies, Verdict::kReported),
                      " are reported without a verdict; the basis of each is beside it.</p>\n");
}

std::string FigureHtml(const FigureRequest& figure, const ReportPage& page) {
  const auto svg = page.figures.find(figure.name);
  if (svg == page.figures.end())
    return absl::StrCat("<p>[Figure ", figure.name, " is missing.] ", Escaped(figure.caption), "</p>\n");
  return absl::StrCat("<figure><img alt=\"", Escaped(figure.caption), "\" src=\"data:image/svg+xml;base64,",
                      absl::Base64Escape(svg->second), "\"><figcaption>", Escaped(figure.caption),
                      "</figcaption></figure>\n");
}

std::string StudyHtml(const Study& study, const ReportPage& page) {
  std::string html = absl::StrCat("<h2 id=\"", study.id, "\">", Escaped(study.title), "</h2>\n");
  for (const std::string& paragraph : study.paragraphs) absl::StrAppend(&html, "<p>", Escaped(paragraph), "</p>\n");
  for (const FigureRequest& figure : study.figures) html += FigureHtml(figure, page);
  for (const DataTable& table : study.tables) html += TableHtml(table);
  return html;
}

}  // namespace

std::string HtmlOf(const std::vector<Study>& studies, const ReportPage& page) {
  std::string html = absl::StrCat(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>Validation of albtpu</title><style>",
      kStyle,
      "</style></head><body>\n<h1>The physics of albtpu compared with the paper, the closed form and the "
      "sea</h1>\n",
      "<p class=\"made-by\">", Escaped(page.made_by), "</p>\n");
  if (!page.why_figures_are_missing.empty()) {
    absl::StrAppend(&html, "<p><strong>Figures are missing:</strong> ", Escaped(page.why_figures_are_missing),
                    "</p>\n");
  }
  html += CountsHtml(studies) + "<ul>";
  for (const Study& study : studies)
    absl::StrAppend(&html, "<li><a href=\"#", study.id, "\">", Escaped(study.title), "</a></li>");
  html += "</ul>\n" + SummaryHtml(studies);
  for (const Study& study : studies) html += StudyHtml(study, page);
  return html + "</body></html>\n";
}

}  // namespace albtpu
