// [project] of the survey file: what a report names. No number depends on it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "config/key.h"

namespace albtpu::config {

struct ProjectSettings {
  std::optional<std::string> name, number, client, surveyor, area, aircraft, dates, remarks;
};

// clang-format off
inline constexpr std::array<Key<ProjectSettings>, 8> kProjectKeys = {{
    {{"name", "", Text{"the name of the project", "NAME"}, "", "The project, as the report is headed"},
     &ProjectSettings::name},
    {{"number", "", Text{"the number of the project or contract", "NUMBER"}, "", "Its number, or that of the contract"},
     &ProjectSettings::number},
    {{"client", "", Text{"the name of the client", "NAME"}, "", "For whom the survey was made"},
     &ProjectSettings::client},
    {{"surveyor", "", Text{"a name or a company", "NAME"}, "", "Who made the survey, and signs the report"},
     &ProjectSettings::surveyor},
    {{"area", "", Text{"the name of the area", "NAME"}, "", "Where it was flown"}, &ProjectSettings::area},
    {{"aircraft", "", Text{"the aircraft", "NAME"}, "", "The aircraft, such as its type and registration"},
     &ProjectSettings::aircraft},
    {{"dates", "", Text{"the days of the flight", "TEXT"}, "by the GPS times of the points", "When it was flown"},
     &ProjectSettings::dates},
    {{"remarks", "", Text{"text", "TEXT"}, "", "What else the report says at its beginning"},
     &ProjectSettings::remarks},
}};
// clang-format on

}  // namespace albtpu::config
