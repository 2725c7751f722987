// The report as one self-contained HTML page, with style, numbers and figures inside.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/report/study.h"

namespace albtpu {

struct ReportPage {
  std::string made_by;                         // program, version, commit, effort
  std::map<std::string, std::string> figures;  // SVG by name; the page says which ones are missing
  std::string why_figures_are_missing;         // empty if none is
};

std::string HtmlOf(const std::vector<Study>& studies, const ReportPage& page);

}  // namespace albtpu
