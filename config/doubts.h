// Standard deviations of a survey file that are possible, but so large that they may be in another unit than theirs.
#pragma once

#include <string>
#include <vector>

#include "config/survey_settings.h"

namespace albtpu::config {

// A message for each: "[sigma] position is 17, 17, 17 m, more than 1 m: is it in m, not in cm or mm?"
std::vector<std::string> Doubts(const SurveySettings& settings);

}  // namespace albtpu::config
