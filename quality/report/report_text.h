// The verdict of a report in some lines, for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace albtpu::quality {

// `report` is SurveyReport::json.
std::string ReportText(const nlohmann::ordered_json& report);

}  // namespace albtpu::quality
