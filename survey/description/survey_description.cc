#include "survey/description/survey_description.h"

#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "command_line/one_line.h"
#include "sea/sea_time.h"
#include "survey/description/toml_keys.h"

namespace albtpu::client {
namespace {

namespace fs = std::filesystem;

// A hundred times what a survey needs. A longer text could nest keys so deeply ("a.a.a ...") that the TOML parser,
// which recurses into each level, would overflow the stack.
constexpr std::size_t kMostBytes = 32768;

template <typename Words>
std::vector<std::string> Texts(const Words& words) {
  return {words.begin(), words.end()};
}

JonswapWaves ReadWaves(TomlKeys& keys) {
  ToldWaves told;
  for (const auto& each : kWaveNumbers)
    told.*each.field = keys.Number(each.key, each.least, each.greatest, each.unit);
  told.spreading = keys.OneOf("spreading", {std::string(kMitsuyasu)});
  keys.Finish();
  const std::string problem = ProblemOf(told, "");
  if (problem.empty()) return WavesOf(told);
  keys.Fail(problem);
  return {};
}

ToldSea ReadSea(TomlKeys& keys, const fs::path& folder) {
  ToldSea sea;
  for (const auto& each : kSeaNumbers)
    sea.*each.field = keys.Number(each.key, each.least, each.greatest, each.unit);
  sea.tail = keys.OneOf("tail", Texts(kTailRules));
  sea.place = keys.Text("place", "a name, or \"LAT,LON\"");
  sea.time = keys.Text("time", "UTC, such as \"2020-06-08T03:50Z\"");
  sea.file = keys.Text("file", "the path of a file of the sea");
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value())
    keys.Fail("time is no time; give UTC as \"2020-06-08T03:50Z\"");
  if (sea.file.has_value()) sea.file = (folder / *sea.file).string();
  for (TomlKeys& waves : keys.Tables("waves")) sea.waves.push_back(ReadWaves(waves));
  keys.Finish();
  return sea;
}

}  // namespace

absl::StatusOr<SurveyDescription> ParseSurvey(std::string_view text, const fs::path& folder) {
  if (text.size() > kMostBytes) {
    return absl::InvalidArgumentError(absl::StrCat("has ", text.size(), " bytes (a survey file has at most ",
                                                   kMostBytes, "); give the TOML that describes the survey"));
  }
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(absl::StrCat("line ", error.source().begin.line, ": is not TOML (",
                                                   OneLine(std::string(error.description())),
                                                   "); correct it"));
  }
  TomlProblem problem;
  TomlKeys keys(root, "", problem);
  SurveyDescription survey;
  for (TomlKeys& sea : keys.Table("sea")) survey.sea = ReadSea(sea, folder);
  keys.Finish();
  if (!problem.status().ok()) return problem.status();
  return survey;
}

absl::StatusOr<SurveyDescription> ReadSurvey(const fs::path& path) {
  const auto error = [&](absl::StatusCode code, absl::string_view message) {
    return absl::Status(code, absl::StrCat(path.string(), ": ", message));
  };
  std::error_code unknown;
  if (!fs::exists(path, unknown))
    return error(absl::StatusCode::kNotFound, "does not exist; check the path of --survey");
  if (!fs::is_regular_file(path, unknown))
    return error(absl::StatusCode::kFailedPrecondition, "is not a regular file; give a file of TOML");
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file && !file.eof())
    return error(absl::StatusCode::kUnavailable, "cannot be read; check its permissions");
  text.resize(static_cast<std::size_t>(file.gcount()));
  absl::StatusOr<SurveyDescription> survey = ParseSurvey(text, path.parent_path());
  if (!survey.ok()) return error(survey.status().code(), survey.status().message());
  return survey;
}

}  // namespace albtpu::client
