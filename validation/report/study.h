// What a validation study finds: comparisons with a verdict, tables of numbers, figures drawn from the tables.
//
// A study computes; it formats nothing. The report writes each table as CSV, lets matplotlib draw the figures
// from the CSVs, and puts all of it on one page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();  // an empty cell of a table

using Cell = std::variant<double, std::string>;

// Written as NAME.csv, one line of column names first.
struct DataTable {
  std::string name;                  // "table_3": lower case and underscores
  std::string title;                 // one sentence
  std::vector<std::string> columns;  // with the unit: "along_wind_deg"
  std::vector<std::vector<Cell>> rows;
  bool on_the_page = true;  // false: too long to read; the CSV has it
};

// Drawn by the function of this name in plots/, which reads the CSVs of its study.
struct FigureRequest {
  std::string name;     // "figure_8"
  std::string caption;  // what it shows and what to see in it
};

enum class Verdict {
  kAgrees,    // within the tolerance that `basis` derives
  kDiffers,   // outside of it; the study's text says why, as far as that is known
  kReported,  // shown without a judgement: `basis` says why none is possible
};

// One line of the summary.
struct Comparison {
  std::string quantity;  // "2-sigma along wind, 5.25 m/s, nadir"
  std::string unit;
  double published = kNoNumber;
  double ours = kNoNumber;
  double standard_error = kNoNumber;  // of ours; kNoNumber where ours is exact
  Verdict verdict = Verdict::kReported;
  std::string basis;  // how the verdict was reached: "within 0.010 m: two decimals are printed, and ..."
};

struct Study {
  std::string id;                       // anchor of its section: "table_3"
  std::string title;                    // "Table 3: the paper's Monte Carlo"
  std::vector<std::string> paragraphs;  // plain text: what was done, what came out, why it differs
  std::vector<Comparison> comparisons;
  std::vector<DataTable> tables;
  std::vector<FigureRequest> figures;
};

struct StudyOptions {
  std::filesystem::path published;  // the folder of the paper's tables as CSV
  bool quick = false;  // minutes on two cores; otherwise the paper's own numbers of surfaces and rays
  std::uint64_t seed = 1;
};

// Every study is a function of its options alone. What is wrong with the published tables comes back as a status.
using StudyFunction = absl::StatusOr<Study> (*)(const StudyOptions&);

}  // namespace albtpu
