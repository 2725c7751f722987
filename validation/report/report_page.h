// The report as one HTML page that needs nothing else: style, numbers and figures are inside.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/report/study.h"

namespace albtpu {

struct ReportPage {
  std::string made_by;                         // program, version, commit, effort
  std::map<std::string, std::string> figures;  // SVG by name; one that is missing is said to be
  std::string why_figures_are_missing;         // empty: none is
};

std::string HtmlOf(const std::vector<Study>& studies, const ReportPage& page);

}  // namespace albtpu
