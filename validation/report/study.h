// The result of a validation study: comparisons with a verdict, tables of numbers, figures drawn from the tables.
//
// A study computes and does not format. The report writes each table as CSV (RFC 4180, lines end in a line feed),
// draws the figures from the CSV files with matplotlib, and puts everything on one page.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/math/statistics.h"

namespace albtpu {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();  // an empty cell of a table

using Cell = std::variant<double, std::string>;

// Written as NAME.csv, with a line of column names first.
struct DataTable {
  std::string name;                  // "table_3": lower case and underscores
  std::string title;                 // one sentence
  std::vector<std::string> columns;  // with the unit: "along_wind_deg"
  std::vector<std::vector<Cell>> rows = {};
  bool on_the_page = true;  // false: too long to read, in the CSV file only

  // Adds a row. An Estimate fills two cells, with its value and its standard error; a vector of cells fills its cells.
  template <typename... Values>
  void Add(const Values&... values) {
    rows.emplace_back();
    (Append(values), ...);
  }

 private:
  void Append(double number) { rows.back().emplace_back(number); }
  void Append(const char* text) { rows.back().emplace_back(text); }
  void Append(std::string_view text) { rows.back().emplace_back(std::string(text)); }
  void Append(const Estimate& estimate) { Append(estimate.value), Append(estimate.standard_error); }
  void Append(const std::vector<Cell>& cells) { rows.back().insert(rows.back().end(), cells.begin(), cells.end()); }
};

// Drawn by the function of this name in plots/, which reads the CSV files of its study.
struct FigureRequest {
  std::string name;     // "figure_8"
  std::string caption;  // what the figure shows
};

enum class Verdict {
  kAgrees,    // within the tolerance that `basis` derives
  kDiffers,   // outside of it; the text of the study gives the reason, as far as it is known
  kReported,  // without a verdict: `basis` says why none is possible
};
inline Verdict AgreesIf(bool within) { return within ? Verdict::kAgrees : Verdict::kDiffers; }

// One line of the summary.
struct Comparison {
  std::string quantity;  // "2-sigma along wind, 5.25 m/s, nadir"
  std::string unit;
  double published = kNoNumber;
  double ours = kNoNumber;
  double standard_error = kNoNumber;  // of ours; kNoNumber if ours is exact
  Verdict verdict = Verdict::kReported;
  std::string basis;  // of the verdict: "within 0.010 m: two decimals are printed, and ..."
};

// The range of numbers.
struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

  void Add(double number) {
    least = std::min(least, number);
    most = std::max(most, number);
  }
};

struct Study {
  std::string id;                       // anchor of its section: "table_3"
  std::string title;                    // "Table 3: the paper's Monte Carlo"
  std::vector<std::string> paragraphs;  // plain text: method, result, reasons for differences
  std::vector<Comparison> comparisons;
  std::vector<DataTable> tables;
  std::vector<FigureRequest> figures;
};

struct StudyOptions {
  std::filesystem::path published;  // the folder of the paper's tables as CSV
  bool quick = false;               // minutes on two cores; otherwise the paper's numbers of surfaces and rays
  std::uint64_t seed = 1;
};

// Every study is a function of its options alone. Errors in the published tables are returned as a status.
using StudyFunction = absl::StatusOr<Study> (*)(const StudyOptions&);

// The table as CSV. Numbers have nine significant digits; kNoNumber is an empty cell.
std::string CsvOf(const DataTable& table);

// The comparisons of all studies as one table, as the report shows them.
DataTable SummaryOf(const std::vector<Study>& studies);

// The number of comparisons in all studies that have this verdict.
int Count(const std::vector<Study>& studies, Verdict verdict);

std::string_view Name(Verdict verdict);  // "agrees", "differs", "reported"

}  // namespace albtpu
