// The scanners of a file that has points of several: [[sensor.channel]] of a survey file. Each maps scanner channels or
// user data of LAS points to a sensor with what belongs to it alone.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/key.h"
#include "config/sensors/sensor.h"

namespace albtpu::config {

struct ChannelSettings {                         // [[sensor.channel]]
  std::vector<int> scanner_channels, user_data;  // An empty one: all.
  std::optional<std::string> name;               // As [sensor] name.
  std::optional<Triple> lever_arm;               // m; absent: that of [sensor].
  // In place of the flags --footprint, --divergence, --aperture and --incidence.
  std::optional<double> footprint, divergence, aperture, incidence;  // m, mrad, m, degree
  StatedErrors sigma;                                                // Before those of [sigma].

  // "scanner channel 1", "user data 3, 4"
  std::string label() const;
};

// The channel of a scanner has two bits in point formats 6 to 10, user data one byte in all formats.
inline constexpr WholeNumbers kScannerChannels = {0, 3}, kUserData = {0, 255};
// The longest aircraft has 84 m (An-225).
inline constexpr ThreeNumbers kLeverArm = {-100, 100, "m", "[forward, right, down]", "X,Y,Z"};

// clang-format off
inline constexpr std::array<Key<ChannelSettings>, 8> kChannelKeys = {{
    {{"scanner_channels", "", kScannerChannels, "all",
      "The scanner channels of its points, in point formats 6 to 10; give this, user_data or both"},
     &ChannelSettings::scanner_channels},
    {{"user_data", "", kUserData, "all", "The user data of its points"}, &ChannelSettings::user_data},
    {{"name", "", Text{"the name of a sensor, or the path of its file", "NAME|FILE.toml"}, "",
      "The lidar of the channel, as [sensor] name, which then is not given"},
     &ChannelSettings::name},
    {{"lever_arm", "", kLeverArm, "that of [sensor]", "From the trajectory's reference point to the laser"},
     &ChannelSettings::lever_arm},
    {{"footprint", "", Number{0.01, 100, "m"}, "by the divergence", "Diameter of the beam on the water, across it"},
     &ChannelSettings::footprint},
    {{"divergence", "", Number{kLeastDivergence, kGreatestDivergence, "mrad"}, "that of the flags, else of the sensor",
      "Divergence of the beam, full angle"},
     &ChannelSettings::divergence},
    {{"aperture", "", Number{0, 1, "m"}, "0", "Diameter of the beam where it leaves the sensor, with a divergence"},
     &ChannelSettings::aperture},
    {{"incidence", "", Number{0, 60, "degree"}, "", "One angle of all its beams from the vertical, as --incidence"},
     &ChannelSettings::incidence},
}};
// clang-format on

// The channels under `sensor`, a table of the survey file. Problems: a channel that maps no points or points of another
// one, without a name, or beside a name of [sensor].
std::vector<ChannelSettings> ReadChannels(TomlKeys& sensor, const std::filesystem::path& folder);

}  // namespace albtpu::config
