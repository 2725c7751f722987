// Survey files as text: what is read from them, or why none is.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "config/survey_settings.h"

namespace albtpu::config {

inline SurveySettings Survey(const std::string& text) {
  absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "/data");
  EXPECT_TRUE(survey.ok()) << text << survey.status();
  return survey.value_or(SurveySettings());
}

inline std::string ErrorOf(const std::string& text) {
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "/data");
  EXPECT_FALSE(survey.ok()) << text;
  return std::string(survey.status().message());
}

}  // namespace albtpu::config
