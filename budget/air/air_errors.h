// What may be wrong on the way from the aircraft to a reported point, before the sea and the water: standard
// deviations, how the water surface was located, and the list of all sources of error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>

namespace albtpu {

// One standard deviation each, in the units of kErrorSources; 0 is an error that does not occur. Errors of different
// sources are independent.
struct AirErrors {
  std::array<double, 3> position = {};
  std::array<double, 3> attitude = {};
  std::array<double, 3> boresight = {};
  double lever_arm = 0;
  double scan = 0;
  double time = 0;
  double range_offset = 0;
  double bottom_range = 0;
  double surface_range = 0;
  double surface_height = 0;
  double index = 0;
};

// How the processing of the survey found where each beam entered the water.
enum class SurfaceLocation : std::uint8_t {
  kPulse,  // By the pulse's own return from the surface.
  kLocal,  // By a model of the surface, made of the survey's own returns from it. Moves with the trajectory.
  kLevel,  // By a water level, whose height is known apart from the trajectory.
};
inline constexpr std::array<std::string_view, 3> kSurfaceLocationNames = {"pulse", "local", "level"};

// What errors average out over. A mean over many pulses keeps the errors of line and survey, a mean over many lines
// those of the survey.
enum class ErrorGroup : std::uint8_t {
  kPulse,   // Drawn anew for each pulse: scan angle, range, sea surface.
  kLine,    // Common to neighbouring pulses of a line: position and attitude of the trajectory.
  kSurvey,  // Common to all: boresight, lever arm, time, range offset, index, water level, datum.
};
inline constexpr std::size_t kErrorGroups = 3;
inline constexpr std::array<std::string_view, kErrorGroups> kErrorGroupNames = {"pulse", "line", "survey"};

// A source of error of the air side.
struct ErrorSource {
  // The key in sensor files and in [sigma] of the survey file, the field of albtpu.v1.AirErrors, the keyword in Python.
  std::string_view name;
  std::string_view unit;
  double greatest;                  // Plausible in a file. Wide: it catches a number in another unit.
  std::optional<ErrorGroup> group;  // Absent: GroupOf() says.
  bool of_sensor;                   // A sensor file may state it.
  std::string_view assumption;      // Why `assumed` stands for what nothing states. Empty: it must be stated.
  std::array<double, 3> assumed;
  std::string_view doc;
  double AirErrors::*number = nullptr;  // One of these two is set.
  std::array<double, 3> AirErrors::*numbers = nullptr;
  std::array<std::string_view, 3> parts = {};  // Of three numbers, as on the wire.

  constexpr std::size_t size() const { return numbers != nullptr ? 3 : 1; }
  constexpr std::span<double> In(AirErrors& errors) const {
    return numbers != nullptr ? std::span<double>(errors.*numbers) : std::span<double>(&(errors.*number), 1);
  }
  constexpr std::span<const double> In(const AirErrors& errors) const {
    return numbers != nullptr ? std::span<const double>(errors.*numbers)
                              : std::span<const double>(&(errors.*number), 1);
  }
  constexpr bool Is(double AirErrors::*member) const { return number == member; }
  constexpr bool Is(std::array<double, 3> AirErrors::*member) const { return numbers == member; }
};

// All sources, in the order of AirErrors: the one place that declares them. Sensor files, [sigma], the numbers that a
// total states, the check and the messages of a query are made of this list; budget.proto and docs/budget.md are tested
// against it.
//
// What is assumed is a well calibrated system with a good trajectory, as post-processed GNSS and inertial navigation of
// airborne surveys state it (data sheets of Applanix AP and POS AV, PPK). Sea water of 5 to 30 degrees C and salinities
// of 25 to 38 has an index of 1.337 to 1.344 at 532 nm (Quan and Fry 1995).
// clang-format off
inline constexpr ErrorSource kErrorSources[] = {
    {.name = "position", .unit = "m", .greatest = 100, .group = ErrorGroup::kLine, .of_sensor = true,
     .assumption = "a good post-processed trajectory", .assumed = {0.02, 0.02, 0.06}, .doc = "of the trajectory",
     .numbers = &AirErrors::position, .parts = {"north", "east", "down"}},
    {.name = "attitude", .unit = "degree", .greatest = 10, .group = ErrorGroup::kLine, .of_sensor = true,
     .assumption = "a good post-processed trajectory", .assumed = {0.005, 0.005, 0.008}, .doc = "of the trajectory",
     .numbers = &AirErrors::attitude, .parts = {"roll", "pitch", "heading"}},
    {.name = "boresight", .unit = "degree", .greatest = 10, .group = ErrorGroup::kSurvey, .of_sensor = true,
     .assumption = "a good calibration", .assumed = {0.001, 0.001, 0.004},
     .doc = "rotations of the sensor about the axes of the aircraft", .numbers = &AirErrors::boresight,
     .parts = {"forward", "right", "down"}},
    {.name = "lever_arm", .unit = "m", .greatest = 10, .group = ErrorGroup::kSurvey, .of_sensor = true,
     .assumption = "a good survey of it", .assumed = {0.02}, .doc = "of each axis", .number = &AirErrors::lever_arm},
    {.name = "scan", .unit = "degree", .greatest = 5, .group = ErrorGroup::kPulse, .of_sensor = true,
     .assumption = "", .assumed = {}, .doc = "of each of two angles across the beam", .number = &AirErrors::scan},
    {.name = "time", .unit = "s", .greatest = 1, .group = ErrorGroup::kSurvey, .of_sensor = true,
     .assumption = "hardware time stamps", .assumed = {1e-5}, .doc = "of the laser's clock against the trajectory's",
     .number = &AirErrors::time},
    {.name = "range_offset", .unit = "m", .greatest = 10, .group = ErrorGroup::kSurvey, .of_sensor = true,
     .assumption = "calibrated", .assumed = {0}, .doc = "of all ranges alike", .number = &AirErrors::range_offset},
    {.name = "bottom_range", .unit = "m", .greatest = 10, .group = ErrorGroup::kPulse, .of_sensor = true,
     .assumption = "", .assumed = {}, .doc = "of the range to the bottom, optical",
     .number = &AirErrors::bottom_range},
    // Where nothing states it, that of the bottom stands for it.
    {.name = "surface_range", .unit = "m", .greatest = 10, .group = ErrorGroup::kPulse, .of_sensor = true,
     .assumption = "as good as the range to the bottom", .assumed = {},
     .doc = "of the range to the surface, where the pulse's own return located it",
     .number = &AirErrors::surface_range},
    // Of a level; where returns located the surface, the range of one return stands for it.
    {.name = "surface_height", .unit = "m", .greatest = 10, .group = {}, .of_sensor = false,
     .assumption = "a gauge or tide model near by", .assumed = {0.05},
     .doc = "of the height at which the surface was located", .number = &AirErrors::surface_height},
    {.name = "index", .unit = "1", .greatest = 0.1, .group = ErrorGroup::kSurvey, .of_sensor = false,
     .assumption = "sea water of unknown temperature and salinity", .assumed = {0.002},
     .doc = "of the refractive index of the water", .number = &AirErrors::index},
};
// clang-format on
inline constexpr std::size_t kErrorSourceCount = std::size(kErrorSources);

// The error of the height of the surface belongs to the group of its location: that of the own return with the pulse,
// that of a model with the line, because neighbouring pulses share it, that of a level with the survey.
constexpr ErrorGroup GroupOf(const ErrorSource& source, SurfaceLocation located) {
  return source.group.value_or(static_cast<ErrorGroup>(located));
}

// The place of a source in the list, and of the first of its numbers among those of all sources.
template <typename Member>
constexpr std::size_t Index(Member AirErrors::*member) {
  std::size_t i = 0;
  while (!kErrorSources[i].Is(member)) ++i;
  return i;
}
template <typename Member>
constexpr std::size_t FirstNumber(Member AirErrors::*member) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < Index(member); ++i) first += kErrorSources[i].size();
  return first;
}
inline constexpr std::size_t kErrorNumberCount = [] {
  std::size_t count = 0;
  for (const ErrorSource& source : kErrorSources) count += source.size();
  return count;
}();
static_assert(sizeof(AirErrors) == kErrorNumberCount * sizeof(double), "a member of AirErrors is not in the list");

}  // namespace albtpu
