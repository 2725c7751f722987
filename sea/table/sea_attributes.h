// The attributes by which the table of one sea describes it, and the azimuths of beams in its frame.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sea/spectra/described_sea.h"
#include "sea/spectra/spectral_tail.h"
#include "tables/provenance.h"

namespace albtpu {

// The attributes of these tables, beside those that all tables have (FORMAT.md).
namespace sea_attribute {
inline constexpr std::string_view kXAzimuth = "x_azimuth";                             // degree, of the compass
inline constexpr std::string_view kSignificantWaveHeight = "significant_wave_height";  // m
inline constexpr std::string_view kWindSpeed = "wind_speed_10m";                       // m/s
inline constexpr std::string_view kWindSource = "wind_source";        // "told" (given), "waves" or "unknown" (a calm)
inline constexpr std::string_view kWaterDepth = "water_depth";        // m; absent in deep water
inline constexpr std::string_view kTail = "tail";                     // Name(TailRule); absent without one
inline constexpr std::string_view kTailFrom = "tail_from";            // Hz; absent without resolved waves
inline constexpr std::string_view kShareMeasured = "share_measured";  // ShareMeasured()
inline constexpr std::string_view kAssumptions = "assumptions";       // Sentences(), a line each; absent if none
}  // namespace sea_attribute

// The azimuth in the table [degree] of a beam that travels towards `compass_azimuth` [degree], over a sea whose x axis
// points to `x_azimuth` [degree of the compass]. The compass turns clockwise, and azimuths of the table turn from x to
// y, which is the other way.
constexpr double BeamAzimuth(double compass_azimuth, double x_azimuth) { return x_azimuth - compass_azimuth; }

// The fraction, 0 to 1, of the slope variance under a vertical uniform beam of 0.6 m, a usual diameter, that comes from
// resolved waves; the rest comes from the tail. 0 without waves.
double ShareMeasured(const DescribedSea& sea);

// The assumptions as sentences for people, one each.
std::vector<std::string> Sentences(const SeaAssumptions& assumed);

// The attributes above; `tail` is the rule that was applied, if one was.
std::map<std::string, AttributeValue> AttributesOf(const DescribedSea& sea, std::optional<TailRule> tail);

}  // namespace albtpu
