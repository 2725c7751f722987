#include "survey/description/survey_description.h"

#include <string>

#include "survey/description/survey_sections.h"
#include "survey/toml/toml_file.h"

namespace albtpu::client {
namespace {

namespace fs = std::filesystem;

constexpr TomlKind kSurveyFile = {"a survey file", "the survey", "the path of --survey"};

}  // namespace

absl::StatusOr<SurveyDescription> ParseSurvey(std::string_view text, const fs::path& folder) {
  const absl::StatusOr<toml::table> root = ParseToml(text, kSurveyFile);
  if (!root.ok()) return root.status();
  TomlProblem problem(kSurveyFile);
  TomlKeys keys(*root, "", problem);
  SurveyDescription survey;
  for (TomlKeys& section : keys.Table("sensor")) survey.sensor = ReadToldSensor(section, folder);
  for (TomlKeys& section : keys.Table("trajectory")) survey.trajectory = ReadTrajectory(section, folder);
  for (TomlKeys& section : keys.Table("surface")) survey.surface = ReadSurface(section, folder);
  for (TomlKeys& section : keys.Table("sea")) survey.sea = ReadSea(section, folder);
  for (TomlKeys& section : keys.Table("water")) survey.water = ReadWater(section);
  for (TomlKeys& section : keys.Table("datum")) survey.datum = ReadDatum(section);
  for (TomlKeys& section : keys.Table("sigma")) survey.sigma = ReadSigma(section);
  for (TomlKeys& section : keys.Table("output")) survey.output = ReadOutput(section);
  keys.Finish();
  if (!problem.status().ok()) return problem.status();
  return survey;
}

absl::StatusOr<SurveyDescription> ReadSurvey(const fs::path& path) {
  const absl::StatusOr<std::string> text = ReadTomlText(path, kSurveyFile);
  if (!text.ok()) return text.status();
  absl::StatusOr<SurveyDescription> survey = ParseSurvey(*text, path.parent_path());
  if (!survey.ok()) return InFile(path, survey.status());
  return survey;
}

}  // namespace albtpu::client
