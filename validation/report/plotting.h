// Figures by matplotlib, from the CSV files of a report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace albtpu {

// Runs plots/draw.py by Debian's Python: `figures` from the CSVs in `folder` to SVGs beside them. A figure
// that cannot be drawn is left out. Returns why figures are missing, one line; empty if none is.
std::string DrawFigures(const std::filesystem::path& plots, const std::filesystem::path& folder,
                        const std::vector<std::string>& figures);

}  // namespace albtpu
