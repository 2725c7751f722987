// Standard deviations of a survey file that are possible, but so large that they may be in another unit than theirs.
#pragma once

#include <string>
#include <vector>

#include "config/survey_settings.h"

namespace albtpu::config {

// A message for each: "[sigma] position is 17, 17, 17 m, more than 1 m: is it a standard deviation in m, not in cm or
// mm?" The bounds are judgements: a survey beyond them is of little use.
std::vector<std::string> Doubts(const SurveySettings& settings);

}  // namespace albtpu::config
