#include "config/sensor_channels.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace albtpu::config {
namespace {

// Where neither has numbers, both have all; where both have some, those that they share. `any` stands for all.
bool Share(const std::vector<int>& a, const std::vector<int>& b) {
  return a.empty() || b.empty() ||
         std::ranges::any_of(a, [&](int number) { return std::ranges::find(b, number) != b.end(); });
}

bool SharePoints(const ChannelSettings& a, const ChannelSettings& b) {
  return Share(a.scanner_channels, b.scanner_channels) && Share(a.user_data, b.user_data);
}

ChannelSettings ReadChannel(TomlKeys& keys, const std::filesystem::path& folder) {
  ChannelSettings channel;
  ReadKeys(keys, kChannelKeys, folder, channel);
  for (TomlKeys& sigma : keys.Table("sigma")) {
    for (std::size_t i = 0; i < kErrorSourceCount; ++i)
      if (kErrorSources[i].of_sensor) ReadErrors(sigma, kErrorSources[i].name, i, channel.sigma);
    sigma.Finish();
  }
  keys.Finish();
  if (!keys.Has("name")) keys.Fail("name is missing; give the sensor of the channel");
  if (!keys.Has("scanner_channels") && !keys.Has("user_data"))
    keys.Fail("maps no points; give scanner_channels = [0], user_data = [1] or both");
  if (keys.Has("footprint") && (keys.Has("divergence") || keys.Has("aperture")))
    keys.Fail("footprint",
              "is given beside divergence or aperture (each gives the size of the beam); give one of them");
  if (channel.name.has_value() && IsSensorFile(*channel.name)) channel.name = (folder / *channel.name).string();
  return channel;
}

}  // namespace

std::string ChannelSettings::label() const {
  std::vector<std::string> parts;
  if (!scanner_channels.empty())
    parts.push_back(absl::StrCat("scanner channel ", absl::StrJoin(scanner_channels, ", ")));
  if (!user_data.empty()) parts.push_back(absl::StrCat("user data ", absl::StrJoin(user_data, ", ")));
  return absl::StrJoin(parts, " with ");
}

std::vector<ChannelSettings> ReadChannels(TomlKeys& sensor, const std::filesystem::path& folder) {
  std::vector<ChannelSettings> channels;
  for (TomlKeys& keys : sensor.Tables("channel")) {
    ChannelSettings channel = ReadChannel(keys, folder);
    for (const ChannelSettings& other : channels)
      if (SharePoints(channel, other))
        keys.Fail(absl::StrCat("maps points of ", channel.label(), ", and another one those of ", other.label(),
                               " (each point has one sensor); map no point twice"));
    channels.push_back(std::move(channel));
  }
  if (!channels.empty() && sensor.Has("name"))
    sensor.Fail("name", "contradicts [[sensor.channel]] (each channel names its sensor); give one of them");
  return channels;
}

}  // namespace albtpu::config
