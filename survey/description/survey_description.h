// The survey file: what is known of a survey beside its points, as TOML.
//
//     [sensor]
//     name = "riegl-vq-880-g"             # installed; or the path of a file: "my_sensor.toml"
//     lever_arm = [0.3, -0.2, 0.5]        # m: forward, right, down
//     [trajectory]
//     files = ["sbet/"]                   # or: from_returns = true
//     errors = ["smrmsg/"]
//     time = "gps"                        # "utc"
//     [surface]
//     classes = [41]                      # of returns from the surface
//     located = "local"                   # "pulse"; "level", with: level = -23.09, or "level.csv"
//     [sea]
//     wind_speed = 6.5                    # m/s at 10 m; 0 is a calm
//     wind_from = 225                     # degree, true
//     water_depth = 12                    # m; absent: deep
//     tail = "relax"                      # "wind", "level", "none"
//     tail_from = 0.95                    # Hz; absent: up to where the waves can be trusted
//     [[sea.waves]]                       # any number; or: file = "41010.data_spec"
//     hs = 0.42                           # m
//     tp = 2.7                            # s
//     gamma = 3.3
//     waves_from = 225                    # degree, true
//     spreading = "mitsuyasu"             # or spread = 18, degree
//     [water]
//     kd = 0.12                           # 1/m; or secchi (m), jerlov ("1C"), absorption and scattering (1/m)
//     kd_kind = "diffuse532"              # "satellite490", "system", "secchi", "jerlov"
//     kd_sigma = 0.02                     # 1/m; also omega0, omega0_sigma, backscatter_fraction
//     detector = "peak"                   # "half", "centroid"
//     field_of_view = 3                   # m, diameter on the surface, across the beam
//     pulse_length = 1.5                  # ns
//     photons = 500                       # counted in an echo; absent: their noise is in [sigma] bottom_range
//     bias = "none"                       # "correct", "vendor" with residual_fraction, "calibrated" with
//     calibration = {depth = 5, offset = -0.04, sigma = 0.01}   # m; positive: too shallow
//     temperature = 24                    # degree C
//     salinity = 36
//     index = 1.3397                      # absent: by temperature and salinity
//     processed_with = 1.33               # the index that the ranges were computed with
//     column = "none"                     # in place of bias: the share of the water column is left out
//     [datum]
//     sigma = 0.08                        # m
//     geoid_separation = -25.1            # m
//     [sigma]                             # 1 sigma, in place of the sensor's and of the error files'; 0 is none:
//     position = [0.02, 0.02, 0.06]       # m; the keys are all sources of error in budget/air/air_errors.h
//     scan = 0.02                         # degree
//     [output]
//     classes = [40]
//     coverage = "p95"                    # "2sigma", "1sigma"
//     s44_order = "1b"
//     details = true
//
// With a file of the sea: time = "2020-06-08T03:50Z" (absent: by the time of each pulse), place, longest_gap (h),
// anemometer_height (m). Paths count from the folder of the survey file.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "absl/status/statusor.h"
#include "survey/description/told_survey.h"

namespace albtpu::client {

struct SurveyDescription {
  std::optional<ToldSensor> sensor;
  std::optional<ToldTrajectory> trajectory;
  std::optional<ToldSurface> surface;
  std::optional<ToldSea> sea;
  std::optional<ToldWater> water;
  std::optional<ToldDatum> datum;
  std::optional<StatedErrors> sigma;
  std::optional<ToldOutput> output;
};

// InvalidArgument "line 3: ..." at the first problem: what is no TOML, a key that is unknown, of another type or out of
// range, keys that contradict each other, and waves that are incomplete. `folder` is that of relative paths.
absl::StatusOr<SurveyDescription> ParseSurvey(std::string_view text, const std::filesystem::path& folder);

// The same of a file, whose path begins the message.
absl::StatusOr<SurveyDescription> ReadSurvey(const std::filesystem::path& path);

}  // namespace albtpu::client
