// What the user says of a survey in the survey file, beside the sea (survey/seas/told_sea.h). Absent: not said.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/seas/told_sea.h"
#include "survey/sensors/stated_errors.h"

namespace albtpu::client {

using Triple = std::array<double, 3>;

struct ToldSensor {                 // [sensor]
  std::optional<std::string> name;  // Of an installed sensor, or the path of a file: FindSensor().
  std::optional<Triple> lever_arm;  // Forward, right, down, m.
};

struct ToldTrajectory {                    // [trajectory]
  std::vector<std::string> files, errors;  // Files and folders.
  std::optional<std::string> time;         // kTrajectoryTimes
  std::optional<bool> from_returns;
};

struct ToldSurface {                   // [surface]
  std::vector<int> classes;            // Of returns from the surface.
  std::optional<std::string> located;  // kWaysToLocate
  std::optional<double> level;         // In the unit and datum of the points.
  std::optional<std::string> level_file;
};

// A bias of the water column that was measured against what is known of the bottom.
struct ToldCalibration {                       // [water.calibration], or calibration = {...}
  std::optional<double> depth, offset, sigma;  // m; the offset is positive if the points were too shallow
};

struct ToldWater {                                         // [water]
  std::optional<double> index, kd, temperature, salinity;  // 1, 1/m, degree C, 1
  bool without_column = false;  // column = "none": the share of the water is left out.
  // The optics (water_optics.h).
  std::optional<std::string> kd_kind, jerlov;
  std::optional<double> kd_sigma, secchi, absorption, scattering;  // 1/m, m, 1/m, 1/m
  std::optional<double> omega0, omega0_sigma, backscatter_fraction;
  // The receiver, and what the processing did (water_share.h).
  std::optional<std::string> detector, bias;
  std::optional<double> field_of_view, pulse_length, photons;  // m, ns, 1
  std::optional<double> residual_fraction;
  std::optional<ToldCalibration> calibration;
  std::optional<double> processed_with;  // The index that the ranges were computed with.
};

struct ToldDatum {                                // [datum]
  std::optional<double> sigma, geoid_separation;  // m; a sigma of 0 is none.
};

struct ToldOutput {                      // [output]
  std::vector<int> classes;              // Of the points that get an uncertainty.
  std::optional<std::string> coverage;   // kCoverages
  std::optional<std::string> s44_order;  // The names of tables/s44.h.
  std::optional<bool> details;
};

inline constexpr std::array<std::string_view, 2> kTrajectoryTimes = {"gps", "utc"};
// This pulse's own return; a surface of many returns; a height that is told.
inline constexpr std::array<std::string_view, 3> kWaysToLocate = {"pulse", "local", "level"};
inline constexpr std::array<std::string_view, 3> kCoverages = {"2sigma", "p95", "1sigma"};

// The class of a point in LAS 1.4 is one byte.
inline constexpr int kGreatestClass = 255;
// m. The longest aircraft has 84 m (An-225).
inline constexpr double kLongestLeverArm = 100;
// From the Dead Sea to the highest lakes (6400 m), in metres or in feet.
inline constexpr double kLeastLevel = -2000, kGreatestLevel = 25000;

// What EGM2008 has on Earth is -107 to 86 m.
inline constexpr std::array<ToldNumber<ToldDatum>, 2> kDatumNumbers = {{
    {"sigma", "", "m", 0, 10, &ToldDatum::sigma, ""},
    {"geoid_separation", "--geoid-separation", "m", -120, 100, &ToldDatum::geoid_separation, ""},
}};
// Pure water attenuates by more than 0.001 1/m at all wavelengths that pass. Natural water is no warmer than 40 degrees
// and the salt of the ocean 45 at most; it freezes above -2.
inline constexpr std::array<ToldNumber<ToldWater>, 16> kWaterNumbers = {{
    {"index", "--water-index", "1", 1, 1.5, &ToldWater::index, ""},
    {"kd", "", "1/m", 0.001, 10, &ToldWater::kd, ""},
    {"temperature", "", "degree C", -2, 40, &ToldWater::temperature, ""},
    {"salinity", "", "1", 0, 45, &ToldWater::salinity, ""},
    {"kd_sigma", "", "1/m", 0, 10, &ToldWater::kd_sigma, ""},
    {"secchi", "", "m", 0.1, 80, &ToldWater::secchi, ""},
    {"absorption", "", "1/m", 0.001, 10, &ToldWater::absorption, ""},
    {"scattering", "", "1/m", 0.001, 50, &ToldWater::scattering, ""},
    {"omega0", "", "1", 0.05, 0.98, &ToldWater::omega0, ""},
    {"omega0_sigma", "", "1", 0, 0.3, &ToldWater::omega0_sigma, ""},
    {"backscatter_fraction", "", "1", 0.005, 0.05, &ToldWater::backscatter_fraction, ""},
    {"field_of_view", "", "m", 0.1, 1000, &ToldWater::field_of_view, ""},
    {"pulse_length", "", "ns", 0.1, 20, &ToldWater::pulse_length, ""},
    {"photons", "", "1", 1, 1e9, &ToldWater::photons, ""},
    {"residual_fraction", "", "1", 0, 1, &ToldWater::residual_fraction, ""},
    {"processed_with", "", "1", 1, 1.5, &ToldWater::processed_with, ""},
}};
// The offset of a calibration may be negative; none that a survey had was beyond metres.
inline constexpr std::array<ToldNumber<ToldCalibration>, 3> kCalibrationNumbers = {{
    {"depth", "", "m", 0.1, 100, &ToldCalibration::depth, ""},
    {"offset", "", "m", -10, 10, &ToldCalibration::offset, ""},
    {"sigma", "", "m", 0, 10, &ToldCalibration::sigma, ""},
}};

}  // namespace albtpu::client
