// The sections of a survey file from their keys. A problem is remembered by the keys.
#pragma once

#include <filesystem>

#include "survey/description/told_survey.h"
#include "survey/toml/toml_keys.h"

namespace albtpu::client {

// `folder` is that of relative paths.
ToldSea ReadSea(TomlKeys& keys, const std::filesystem::path& folder);
ToldSensor ReadToldSensor(TomlKeys& keys, const std::filesystem::path& folder);
ToldTrajectory ReadTrajectory(TomlKeys& keys, const std::filesystem::path& folder);
ToldSurface ReadSurface(TomlKeys& keys, const std::filesystem::path& folder);
ToldWater ReadWater(TomlKeys& keys);
ToldDatum ReadDatum(TomlKeys& keys);
StatedErrors ReadSigma(TomlKeys& keys);
ToldOutput ReadOutput(TomlKeys& keys);

}  // namespace albtpu::client
