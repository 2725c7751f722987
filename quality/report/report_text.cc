#include "quality/report/report_text.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace albtpu::quality {

std::string ReportText(const nlohmann::ordered_json& report) {
  const auto& wanted = report["wanted"];
  const auto points = wanted["points"].get<std::uint64_t>(),
             numbers = wanted["with_number"].get<std::uint64_t>();
  std::string text =
      absl::StrFormat("%s %s: %s; %.2f %% of %d points meet it (at least %g %% asked)\n",
                      wanted["specification"].get<std::string>(), wanted["class"].get<std::string>(),
                      wanted["passes"].get<bool>() ? "PASSES" : "DOES NOT PASS",
                      100 * wanted["fraction"].get<double>(), points, wanted["pass_share"].get<double>());
  if (numbers < points) {
    std::vector<std::string> why;
    for (const auto& [outcome, count] : wanted["without_number"].items())
      why.push_back(absl::StrCat(count.get<std::uint64_t>(), " ", outcome));
    absl::StrAppend(&text, "  ", points - numbers, " points have no number (", absl::StrJoin(why, ", "),
                    ")\n");
  }
  const auto& check = report["crosscheck"];
  if (check.is_null())
    return text + "  no lines overlap, so that the files cannot show whether the prediction is true\n";
  const auto& factor = check["factor"];
  absl::StrAppendFormat(
      &text,
      "  %d pairs of points of overlapping lines: reduced chi-square %.2f, sigma would have to be "
      "%.2f times as large",
      check["pairs"].get<std::uint64_t>(), check["chi_square"].get<double>(), factor["value"].get<double>());
  if (factor["low"].is_number()) {
    absl::StrAppendFormat(&text, " (%.2f to %.2f)", factor["low"].get<double>(),
                          factor["high"].get<double>());
  }
  return text + "\n";
}

}  // namespace albtpu::quality
