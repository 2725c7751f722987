#include "config/survey_settings.h"

#include <cassert>

namespace albtpu::config {

FlagKey FindFlag(std::string_view flag) {
  FlagKey found;
  ForEachSection([&](const char*, const auto& keys, const auto& section) {
    for (const auto& key : keys) {
      if (key.declaration.flag != flag) continue;
      found = {&key.declaration, [&key, section](const Value& value, SurveySettings& settings) {
                 Put(value, key, section(settings));
               }};
    }
  });
  assert(found.declaration != nullptr);
  return found;
}

SurveySettings Merge(const SurveySettings& flags, SurveySettings file) {
  if (flags.sea.has_waves()) {  // Then what goes with the waves of the survey file goes with them.
    SeaSettings& sea = file.sea;
    sea.waves.clear();
    sea.file = sea.place = sea.time = {};
    sea.longest_gap = sea.anemometer_height = sea.fetch = {};
  }
  if (flags.trajectory.is_given()) file.trajectory = {};
  ForEachSection([&](const char*, const auto& keys, const auto& section) {
    Override(keys, section(flags), section(file));
  });
  if (!flags.sea.waves.empty()) file.sea.waves = flags.sea.waves;
  return file;
}

}  // namespace albtpu::config
