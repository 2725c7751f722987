// The inputs of a pulse: the coordinates of the table, or inputs from which two of them follow.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "tables/schema.h"

namespace albtpu::annotate {

// The axes, with the numbers of AxisId, then
//   azimuth = beam_azimuth - (wind_from + 180 degrees),
//   footprint = altitude / cos(incidence) * divergence.
enum class PulseInput {
  kWindSpeed,
  kFetch,
  kIncidence,
  kAzimuth,
  kFootprint,
  kDepth,
  kBeamAzimuth,  // degree, true, clockwise from north: where the beam travels to
  kWindFrom,     // degree, true, clockwise from north: where the wind comes from
  kAltitude,     // m above the water
  kDivergence,   // mrad, full angle
};
inline constexpr std::size_t kPulseInputCount = 10;
inline constexpr std::array<PulseInput, kPulseInputCount - kAxisCount> kBeamInputs = {
    PulseInput::kBeamAzimuth, PulseInput::kWindFrom, PulseInput::kAltitude, PulseInput::kDivergence};

constexpr std::size_t Index(PulseInput input) { return static_cast<std::size_t>(input); }
constexpr PulseInput InputOf(AxisId axis) { return static_cast<PulseInput>(Index(axis)); }
static_assert(InputOf(AxisId::kDepth) == PulseInput::kDepth && kAxisCount == 6);

std::string_view Name(PulseInput input);  // Of its column: "wind_from".
std::string_view Units(PulseInput input);
std::string FlagName(PulseInput input);  // "--wind-from"
std::string FlagName(AxisId axis);       // "--wind-speed"
std::optional<PulseInput> FindInput(std::string_view name);

// Coordinates that are the same for all pulses, by axis.
using FixedCoordinates = std::array<std::optional<float>, kAxisCount>;

// Inputs that are the same for all pulses.
struct FixedInputs {
  FixedCoordinates coordinates = {};
  std::array<std::optional<float>, kBeamInputs.size()> beam = {};
  // A sea is given, which has its own wind: pulses have no wind speed, fetch and direction of the wind, and an azimuth
  // from a beam_azimuth counts from north.
  bool any_sea = false;

  const std::optional<float>& operator[](PulseInput input) const {
    return Index(input) < kAxisCount ? coordinates[Index(input)] : beam[Index(input) - kAxisCount];
  }
  std::optional<float>& operator[](PulseInput input) {
    return Index(input) < kAxisCount ? coordinates[Index(input)] : beam[Index(input) - kAxisCount];
  }
};

// Two inputs that replace an axis.
struct OtherWay {
  AxisId axis;
  PulseInput first, second;
};
inline constexpr OtherWay kOtherWays[] = {{AxisId::kAzimuth, PulseInput::kBeamAzimuth, PulseInput::kWindFrom},
                                          {AxisId::kFootprint, PulseInput::kAltitude, PulseInput::kDivergence}};

// The numbers of one pulse, by PulseInput.
using PulseNumbers = std::array<float, kPulseInputCount>;

// The direction of the wind by which azimuths count from north: beam_azimuth - (wind_from + 180 degrees).
inline constexpr float kWindForNorth = -180;

// Whether pulses have an input over any sea.
constexpr bool IsOfSea(PulseInput input) {
  return input == PulseInput::kWindSpeed || input == PulseInput::kFetch || input == PulseInput::kWindFrom;
}

// The axis from the two inputs of its other way and the incidence, rounded once. A finite number beyond the range of
// float32 becomes the largest float32 of its sign: it is out of domain, not infinite.
float FromOtherWay(AxisId axis, const PulseNumbers& numbers);

// The sources of the inputs.
enum class InputOrigin { kNone, kColumn, kFlag };
using InputOrigins = std::array<InputOrigin, kPulseInputCount>;

// Whether an axis is given by both inputs of its other way.
bool IsGivenByOtherWay(AxisId axis, const InputOrigins& origins);

// Fails and names both if an axis is given in two ways, or if a flag has no effect because the other input of its way
// is missing: IsUsageError if one of them is a flag. A column that lacks the other input of its way is like any other
// column. `where` begins the message: "pulses.csv line 1", "pulse".
absl::Status CheckWays(const InputOrigins& origins, const std::string& where);

// The coordinates of a pulse that flags alone give, for the command `pulse`. IsUsageError if one that may not be absent
// is missing, and where CheckWays fails.
absl::StatusOr<FixedCoordinates> CoordinatesOf(FixedInputs fixed);

}  // namespace albtpu::annotate
