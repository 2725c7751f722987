// The settings of a survey: the table of the keys of each section, and the survey file and flags that give them.
// Absent: not given. The sea is in sea_settings.h.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/water/known_water.h"
#include "config/key.h"
#include "config/project_settings.h"
#include "config/sea_settings.h"
#include "config/sensor_channels.h"
#include "config/sensors/sensor.h"
#include "sea/water_index.h"
#include "tables/s44.h"

namespace albtpu::config {

struct SensorSettings {                   // [sensor]
  std::optional<std::string> name;        // Of an installed sensor, or the path of a file: FindSensor().
  std::optional<Triple> lever_arm;        // Forward, right, down, m.
  std::vector<ChannelSettings> channels;  // In place of a name, where a file has points of several scanners.
};

struct TrajectorySettings {                  // [trajectory]
  std::vector<std::string> files, errors;    // Files and folders.
  std::optional<std::string> time;           // kTrajectoryTimes
  std::optional<std::string> time_format;    // kTimeFormats, of the points.
  std::optional<std::string> velocity_axes;  // kVelocityAxes
  std::optional<bool> from_returns;

  bool is_given() const { return !files.empty() || from_returns.value_or(false); }
};

struct SurfaceSettings {               // [surface]
  std::vector<int> classes;            // Of returns from the surface.
  std::optional<std::string> located;  // kWaysToLocate
  std::optional<std::string> channel;  // kSurfaceChannels
  std::optional<Level> level;          // In the unit and datum of the points.
  // Of a file of levels, what it does not state: the name of its datum, what is added for that of the points in their
  // unit, and the time zone of its dates.
  std::optional<std::string> level_datum;
  std::optional<double> level_offset, level_hours_from_utc;
};

// A bias of the water column that was measured against what is known of the bottom.
struct CalibrationSettings {                   // [water.calibration], or calibration = {...}
  std::optional<double> depth, offset, sigma;  // m; the offset is positive if the points were too shallow
};

struct WaterSettings {                                     // [water]
  std::optional<double> index, kd, temperature, salinity;  // 1, 1/m, degree C, 1
  std::optional<std::string> column;                       // kColumns
  // The optics (water_optics.h).
  std::optional<std::string> kd_kind, jerlov;
  std::optional<double> kd_sigma, secchi, absorption, scattering;  // 1/m, m, 1/m, 1/m
  std::optional<double> omega0, omega0_sigma, backscatter_fraction;
  // The receiver, and what the processing did (water_contribution.h).
  std::optional<std::string> detector, bias;
  std::optional<double> field_of_view, pulse_length, photons;  // m, ns, 1
  std::optional<double> residual_fraction;
  std::optional<CalibrationSettings> calibration;
  std::optional<double> processed_with;  // The index that the ranges were computed with.

  bool without_column() const { return column.has_value(); }  // The share of the water is left out.
};

struct DatumSettings {                            // [datum]
  std::optional<double> sigma, geoid_separation;  // m; a sigma of 0 is none.
  // In place of sigma: the maximum cumulative uncertainty of a transformation by VDatum, m.
  std::optional<double> mcu;
  std::optional<std::string> confidence;  // kConfidences, of the mcu
  std::optional<std::string> region;      // Of VDatum, as it is recorded.
  std::optional<std::string> name;        // Of the points' heights, where the files do not state it.

  // m, one standard deviation, by whichever is given.
  std::optional<double> standard_deviation() const;
};

// What the surveyor adds to every point beside all that is computed, m, standard deviations; 0: none.
struct ExtraSettings {  // [extra]
  std::optional<double> horizontal, vertical;
};

struct OutputSettings {               // [output]
  std::vector<int> classes;           // Of the points that get an uncertainty.
  std::optional<std::string> points;  // kPointChoices
  std::optional<bool> use_withheld;
  std::optional<bool> terrain_slope;
  std::optional<std::string> coverage;   // kCoverages
  std::optional<std::string> s44_order;  // kS44OrderNames
  std::optional<bool> details;
};

struct SurveySettings {
  SensorSettings sensor;
  TrajectorySettings trajectory;
  SurfaceSettings surface;
  SeaSettings sea;
  WaterSettings water;
  DatumSettings datum;
  ExtraSettings extra;
  config::StatedErrors sigma;  // [sigma], 1 sigma, of the sources in budget/air/air_errors.h
  OutputSettings output;
  ProjectSettings project;

  bool wants_total() const { return sensor.name.has_value() || !sensor.channels.empty(); }
  // That of one of the channels alone, as if its sensor were the only one.
  SurveySettings OfChannel(const ChannelSettings& channel) const;
};

inline constexpr std::array<std::string_view, 2> kTrajectoryTimes = {"gps", "utc"};
inline constexpr std::array<std::string_view, 8> kTimeFormats = {"auto", "week",         "adjusted", "gps",
                                                                 "unix", "milliseconds", "day",      "utc-day"};
inline constexpr std::array<std::string_view, 4> kVelocityAxes = {"auto", "wander", "body", "north"};
// This pulse's own return; a surface of many returns; a height that is given.
inline constexpr std::array<std::string_view, 3> kWaysToLocate = {"pulse", "local", "level"};
inline constexpr std::array<std::string_view, 1> kColumns = {"none"};
inline constexpr std::array<std::string_view, 2> kConfidences = {"1sigma", "95%"};
inline constexpr std::array<std::string_view, 2> kPointChoices = {"all", "bathymetric"};
inline constexpr std::array<std::string_view, 3> kCoverages = {"p95", "2sigma", "1sigma"};
inline constexpr std::string_view kUsualCoverage = "p95";  // As S-44 and NOAA ask.

// The class of a point in LAS 1.4 is one byte.
inline constexpr WholeNumbers kClasses = {0, 255};
// From the Dead Sea to the highest lakes (6400 m), in metres or in feet.
inline constexpr NumberOrPath kLevel = {
    {-2000, 25000, "1"}, "a height, or the path of a file of heights", "Z|FILE.csv"};
// The geoid lies up to 106 m from the ellipsoid, in metres or in feet, and tides of 16 m about it.
inline constexpr Number kLevelOffset = {-500, 500, "1"};
inline constexpr Number kHoursFromUtc = {-12, 14, "h"};
constexpr Number In(const WaterRange& range) { return {range.least, range.greatest, range.unit}; }
inline constexpr Number kWaterIndex = In(kWaterIndexRange);

// clang-format off
inline constexpr std::array<Key<SensorSettings>, 2> kSensorKeys = {{
    {{"name", "--sensor", Text{"the name of a sensor, or the path of its file", "NAME|FILE.toml"}, "",
      "The lidar, by name or file (albtpu-query sensors): give the total uncertainty, with sensor and trajectory, the "
      "location of the surface, the water column and the datum, instead of the contribution of the sea surface alone"},
     &SensorSettings::name},
    {{"lever_arm", "--lever-arm", kLeverArm, "none",
      "From the trajectory's reference point to the laser, in body axes: forward, right, down"},
     &SensorSettings::lever_arm},
}};
inline constexpr std::array<Key<TrajectorySettings>, 6> kTrajectoryKeys = {{
    {{"files", "--trajectory", Paths{}, "", "Trajectory of the sensor, SBET or ASCII: files and folders of files"},
     &TrajectorySettings::files},
    {{"errors", "--trajectory-errors", Paths{}, "", "Its errors, SMRMSG: files and folders of files"},
     &TrajectorySettings::errors},
    {{"time", "--trajectory-time", Word{kTrajectoryTimes}, "gps", "Time scale of the trajectory"},
     &TrajectorySettings::time},
    {{"time_format", "--time-format", Word{kTimeFormats}, "auto",
      "GPS times of the points: auto takes what the file states, or else the only one by which trajectory, water "
      "levels or sea lie at the points; adjusted is GPS seconds less 1e9, gps is GPS seconds since 1980, day and "
      "utc-day are seconds of the day, of GPS time and of UTC"},
     &TrajectorySettings::time_format},
    {{"velocity_axes", "--velocity-axes", Word{kVelocityAxes}, "auto",
      "Axes of an SBET's velocities: auto takes those of the body where these alone agree with its positions"},
     &TrajectorySettings::velocity_axes},
    {{"from_returns", "--trajectory-from-returns", YesOrNo{}, "",
      "Find the trajectory from pulses with two returns under water"},
     &TrajectorySettings::from_returns},
}};
inline constexpr std::array<Key<SurfaceSettings>, 7> kSurfaceKeys = {{
    {{"classes", "--water-classes", kClasses, "",
      "The classes of returns from the water surface; they come before its level where there are any"},
     &SurfaceSettings::classes},
    {{"located", "--surface-located", Word{kWaysToLocate},
      "local with classes of such returns, level without; of a plan level with a water level, local without",
      "How the points' processing found the water surface: by the return of each pulse, a local model of returns or a "
      "level"},
     &SurfaceSettings::located},
    {{"channel", "--surface-channel", Word{kSurfaceChannels}, "infrared: surface returns lie on the surface",
      "The laser whose returns located the surface: a green one finds it too low, by the light that the water scatters "
      "back, unless the processing took this away"},
     &SurfaceSettings::channel},
    {{"level", "--water-level", kLevel, "",
      "Height of the water surface, in the unit and datum of the points' heights, or a CSV file of heights by time"},
     &SurfaceSettings::level},
    {{"level_datum", "--level-datum", Text{"the name of a vertical datum", "NAME"}, "that of the points' heights",
      "The datum of a file of water levels that does not state it, as those of CO-OPS: MLLW, NAVD"},
     &SurfaceSettings::level_datum},
    {{"level_offset", "--level-offset", kLevelOffset, "0",
      "Added to the levels of a file, for the datum of the points' heights and in their unit"},
     &SurfaceSettings::level_offset},
    {{"level_hours_from_utc", "--level-hours-from-utc", kHoursFromUtc, "0",
      "Local time less UTC, of a file of water levels that does not state its time zone, as those of CO-OPS"},
     &SurfaceSettings::level_hours_from_utc},
}};
static_assert(kSeaWaterIndex == 1.34);  // As the text of the index says.
inline constexpr std::array<Key<WaterSettings>, 21> kWaterKeys = {{
    {{"index", "--water-index", kWaterIndex, "by temperature and salinity, or 1.34", "Refractive index of the water"},
     &WaterSettings::index},
    {{"temperature", "", In(kTemperatureRange), "", "Temperature of the water, for its index"},
     &WaterSettings::temperature},
    {{"salinity", "", In(kSalinityRange), "", "Salinity of the water, for its index"}, &WaterSettings::salinity},
    {{"processed_with", "", kWaterIndex, "the group index of the water",
      "The index that the ranges were computed with"},
     &WaterSettings::processed_with},
    {{"column", "--water-column", Word{kColumns}, "", "none: leave out the contribution of the water column"},
     &WaterSettings::column},
    {{"kd", "", In(kKdRange), "", "Attenuation of the water, of the kind that kd_kind says"},
     &WaterSettings::kd},
    {{"kd_kind", "", Word{kKdKindNames}, "", "Where kd is from"}, &WaterSettings::kd_kind},
    {{"kd_sigma", "", In(kKdSigmaRange), "by the kind of kd", "Standard deviation of the attenuation"},
     &WaterSettings::kd_sigma},
    {{"secchi", "", In(kSecchiRange), "", "Secchi depth, in place of kd"}, &WaterSettings::secchi},
    {{"jerlov", "", Word{kJerlovTypes}, "", "Jerlov's type of the water, in place of kd"}, &WaterSettings::jerlov},
    {{"absorption", "", In(kAbsorptionRange), "", "Absorption at 532 nm, with scattering in place of kd"},
     &WaterSettings::absorption},
    {{"scattering", "", In(kScatteringRange), "", "Scattering at 532 nm"}, &WaterSettings::scattering},
    {{"omega0", "", In(kAlbedoRange), "0.8", "Single-scattering albedo"}, &WaterSettings::omega0},
    {{"omega0_sigma", "", In(kAlbedoSigmaRange), "0.1", "Standard deviation of omega0"}, &WaterSettings::omega0_sigma},
    {{"backscatter_fraction", "", In(kBackscatterRange), "0.01 to 0.03",
      "Share of scattered light that turns back"},
     &WaterSettings::backscatter_fraction},
    {{"detector", "", Word{kEchoDetectorNames}, "", "How the receiver reads the bottom from the echo"},
     &WaterSettings::detector},
    {{"field_of_view", "", In(kFieldOfViewRange), "",
      "Diameter of what the receiver sees on the surface, across the beam"},
     &WaterSettings::field_of_view},
    {{"pulse_length", "", In(kPulseLengthRange), "", "Length of the pulse at half its maximum"},
     &WaterSettings::pulse_length},
    {{"photons", "", In(kPhotonsRange), "their noise is in [sigma] bottom_range", "Photons that an echo counts"},
     &WaterSettings::photons},
    {{"bias", "", Word{kBiasHandlingNames}, "",
      "What the processing did about the bias of scattering: none leaves it in the points, correct took away the mean, "
      "vendor left a residual_fraction, calibrated took away the mean scaled to a calibration"},
     &WaterSettings::bias},
    {{"residual_fraction", "", In(kFractionRange), "", "The fraction of the bias that a vendor's correction leaves"},
     &WaterSettings::residual_fraction},
}};
inline constexpr std::array<Key<CalibrationSettings>, 3> kCalibrationKeys = {{
    {{"depth", "", In(kCalibrationDepthRange), "", "Depth at which the bias was measured"},
     &CalibrationSettings::depth},
    {{"offset", "", In(kCalibrationOffsetRange), "", "The bias, positive if the points were too shallow"},
     &CalibrationSettings::offset},
    {{"sigma", "", In(kCalibrationSigmaRange), "", "Its standard deviation"}, &CalibrationSettings::sigma},
}};
// What EGM2008 has on Earth is -107 to 86 m. The regions of VDatum have an mcu of 0.08 to 0.23 m; in centimetres, as
// the table of cBLUE has them, all are 8 or more.
inline constexpr std::array<Key<DatumSettings>, 6> kDatumKeys = {{
    {{"sigma", "--datum-sigma", Number{0, 10, "m"}, "",
      "Standard deviation of the vertical datum; 0 for ellipsoidal heights"},
     &DatumSettings::sigma},
    {{"geoid_separation", "--geoid-separation", Number{-120, 100, "m"}, "",
      "Height of the points' vertical datum above the ellipsoid, where the points are not ellipsoidal"},
     &DatumSettings::geoid_separation},
    {{"mcu", "", Number{0.001, 2, "m"}, "",
      "In place of sigma: the maximum cumulative uncertainty (MCU) that VDatum states for the transformation of "
      "heights; needs confidence"},
     &DatumSettings::mcu},
    {{"confidence", "", Word{kConfidences}, "",
      "What mcu is: 1sigma for one standard deviation, as VDatum and cBLUE state it, or 95% for 1.96 of them"},
     &DatumSettings::confidence},
    {{"region", "", Text{"the name of a region of VDatum", "NAME"}, "",
      "The region of VDatum that mcu or sigma is of; recorded beside it"},
     &DatumSettings::region},
    {{"name", "", Text{"the name of a vertical datum", "NAME"}, "by the coordinate system of the files",
      "The vertical datum of the points' heights, such as NAVD88 (GEOID18), where the files do not state it: reports "
      "and grids name it"},
     &DatumSettings::name},
}};
// An uncertainty of metres from no known source is no survey.
inline constexpr std::array<Key<ExtraSettings>, 2> kExtraKeys = {{
    {{"horizontal", "", Number{0, 10, "m"}, "0",
      "Standard deviation that is added to all that is computed, as the HUC of cBLUE: radial, the root of the sum of "
      "the variances along two axes, which are equal"},
     &ExtraSettings::horizontal},
    {{"vertical", "", Number{0, 10, "m"}, "0", "The same of heights, as the VUC of cBLUE"}, &ExtraSettings::vertical},
}};
inline constexpr std::array<Key<OutputSettings>, 7> kOutputKeys = {{
    {{"classes", "--classes", kClasses, "40, 43; 26 in point formats 0 to 5", "The classes of bathymetric points"},
     &OutputSettings::classes},
    {{"points", "--points", Word{kPointChoices}, "all with a sensor, otherwise bathymetric",
      "The points that get a total: all, those of other classes than --classes without sea and water, as on land; or "
      "bathymetric ones alone. Noise (7, 18) gets none"},
     &OutputSettings::points},
    {{"use_withheld", "--use-withheld", YesOrNo{}, "",
      "Points that are flagged as withheld count as any other; otherwise they get no number and take no part"},
     &OutputSettings::use_withheld},
    {{"terrain_slope", "--terrain-slope", YesOrNo{}, "",
      "The vertical uncertainty of points of the ground (class 2; without any, of unclassified dry points) is that of "
      "the height at a fixed place: with the horizontal error on the slope of the points around, and the spread of the "
      "footprint on it. In LAS files, with a sensor and the direction of each beam"},
     &OutputSettings::terrain_slope},
    {{"coverage", "--coverage", Word{kCoverages}, kUsualCoverage,
      "p95 for 95 %, 2sigma for twice the standard deviation, 1sigma for one standard deviation"},
     &OutputSettings::coverage},
    {{"s44_order", "--s44-order", Word{kS44OrderNames}, "", "Compare with this order of IHO S-44"},
     &OutputSettings::s44_order},
    {{"details", "--details", YesOrNo{}, "",
      "Also append the shares, biases and covariance of a total; in LAS files with or without one the geometry of each "
      "beam: incidence, beam_azimuth, footprint, water_depth, slant_range"},
     &OutputSettings::details},
}};
// clang-format on

// Calls visit(name, keys, section) for each section; section(settings) is its struct. [sigma] has no flags, and its
// keys are the sources of error.
template <typename Visit>
void ForEachSection(const Visit& visit) {
  visit("sensor", kSensorKeys, std::mem_fn(&SurveySettings::sensor));
  visit("trajectory", kTrajectoryKeys, std::mem_fn(&SurveySettings::trajectory));
  visit("surface", kSurfaceKeys, std::mem_fn(&SurveySettings::surface));
  visit("sea", kSeaKeys, std::mem_fn(&SurveySettings::sea));
  visit(
      "sea.waves", kWaveKeys, [](auto& all) -> auto& { return all.sea.wave_flags; });
  visit("water", kWaterKeys, std::mem_fn(&SurveySettings::water));
  visit("datum", kDatumKeys, std::mem_fn(&SurveySettings::datum));
  visit("extra", kExtraKeys, std::mem_fn(&SurveySettings::extra));
  visit("output", kOutputKeys, std::mem_fn(&SurveySettings::output));
  visit("project", kProjectKeys, std::mem_fn(&SurveySettings::project));
}

// A key by its flag, which must be one of a table, and what puts its value into settings.
struct FlagKey {
  const KeyDeclaration* declaration = nullptr;
  std::function<void(const Value&, SurveySettings&)> put;
};
FlagKey FindFlag(std::string_view flag);

// What flags and the survey file give together. A flag overrides the key of the same meaning. Waves that are given by
// flags, in whatever form, override the sea of the file with all that goes with its waves (but not the depth of the
// water), and a trajectory of flags that of the file.
SurveySettings Merge(const SurveySettings& flags, SurveySettings file);

// The survey file: what is known of a survey beside its points, as TOML. docs/survey.md has its keys.

// InvalidArgument "line 3: ..." at the first problem: what is no TOML, a key that is unknown, of another type or out of
// range, keys that contradict each other, and waves that are incomplete. `folder` is that of relative paths.
absl::StatusOr<SurveySettings> ParseSurvey(std::string_view text, const std::filesystem::path& folder);

// The same of a file, whose path begins the message.
absl::StatusOr<SurveySettings> ReadSurvey(const std::filesystem::path& path);

}  // namespace albtpu::config
