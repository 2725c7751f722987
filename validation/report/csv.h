// A study's tables as comma-separated values (RFC 4180, lines end in a line feed).
#pragma once

#include <string>

#include "validation/report/study.h"

namespace albtpu {

// Numbers to nine significant digits; kNoNumber is an empty cell.
std::string CsvOf(const DataTable& table);

// The comparisons of all studies as one table, as the report shows them.
DataTable SummaryOf(const std::vector<Study>& studies);

// How many comparisons of all studies have the verdict.
int Count(const std::vector<Study>& studies, Verdict verdict);

std::string_view Name(Verdict verdict);  // "agrees", "differs", "reported"

}  // namespace albtpu
