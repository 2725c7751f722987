#include "annotate/csv/pulse_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "annotate/answers/batch.h"
#include "annotate/run/file_progress.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

struct BeamInput {
  std::string_view name, units;
};
constexpr BeamInput kBeamInputTexts[kBeamInputs.size()] = {
    {"beam_azimuth", "degree"}, {"wind_from", "degree"}, {"altitude", "m"}, {"divergence", "mrad"}};

float Rounded(double number) {
  constexpr double kGreatest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(number) ? std::clamp(number, -kGreatest, kGreatest) : number);
}

std::string OriginText(PulseInput input, InputOrigin origin) {
  return origin == InputOrigin::kFlag ? FlagName(input) : absl::StrCat("column '", std::string(Name(input)), "'");
}

absl::Status CheckWay(const OtherWay& way, const InputOrigins& origins, const std::string& where) {
  const PulseInput direct = InputOf(way.axis);
  const InputOrigin of_direct = origins[Index(direct)], of_first = origins[Index(way.first)],
                    of_second = origins[Index(way.second)];
  const bool by_other_way = IsGivenByOtherWay(way.axis, origins);
  const bool other_flag = of_first == InputOrigin::kFlag || of_second == InputOrigin::kFlag;
  if (of_direct != InputOrigin::kNone && (by_other_way || other_flag)) {
    std::string others;
    for (const PulseInput input : {way.first, way.second}) {
      const InputOrigin origin = origins[Index(input)];
      if (origin == InputOrigin::kNone) continue;
      absl::StrAppend(&others, others.empty() ? "" : " and ", OriginText(input, origin));
    }
    const std::string message = absl::StrCat(
        where, ": ", OriginText(direct, of_direct), " gives the ", std::string(Name(direct)),
        by_other_way ? absl::StrCat(", and so do ", others) : absl::StrCat(", which ", others, " is for, too"),
        "; leave out one of the two ways");
    const bool any_flag = other_flag || of_direct == InputOrigin::kFlag;
    return any_flag ? formats::UsageError(message) : absl::InvalidArgumentError(message);
  }
  if (of_direct == InputOrigin::kNone && other_flag && !by_other_way) {
    const bool first_given = of_first != InputOrigin::kNone;
    const PulseInput given = first_given ? way.first : way.second;
    const PulseInput missing = first_given ? way.second : way.first;
    return formats::UsageError(absl::StrCat(where, ": ", FlagName(given), " alone does not give the ",
                                            std::string(Name(direct)), "; add ", FlagName(missing),
                                            " or, in a file, a column '", std::string(Name(missing)), "'"));
  }
  return absl::OkStatus();
}

}  // namespace

std::string_view Name(PulseInput input) {
  const std::size_t index = Index(input);
  return index < kAxisCount ? Describe(kAxes[index]).name : kBeamInputTexts[index - kAxisCount].name;
}

std::string_view Units(PulseInput input) {
  const std::size_t index = Index(input);
  return index < kAxisCount ? Describe(kAxes[index]).units : kBeamInputTexts[index - kAxisCount].units;
}

std::string FlagName(PulseInput input) {
  std::string flag = "--";
  for (const char letter : Name(input)) flag += letter == '_' ? '-' : letter;
  return flag;
}

std::string FlagName(AxisId axis) { return FlagName(InputOf(axis)); }

std::optional<PulseInput> FindInput(std::string_view name) {
  if (const std::optional<AxisId> axis = FindAxis(name)) return InputOf(*axis);
  for (const PulseInput input : kBeamInputs)
    if (Name(input) == name) return input;
  return std::nullopt;
}

float FromOtherWay(AxisId axis, const PulseNumbers& numbers) {
  const auto number = [&](PulseInput input) -> double { return numbers[Index(input)]; };
  if (axis == AxisId::kAzimuth)
    return Rounded(DegreesFromDownwind(number(PulseInput::kBeamAzimuth), number(PulseInput::kWindFrom)));
  return Rounded(FootprintAtIncidence(number(PulseInput::kAltitude), number(PulseInput::kDivergence),
                                      number(PulseInput::kIncidence)));
}

bool IsGivenByOtherWay(AxisId axis, const InputOrigins& origins) {
  for (const OtherWay& way : kOtherWays) {
    if (way.axis != axis) continue;
    return origins[Index(way.first)] != InputOrigin::kNone && origins[Index(way.second)] != InputOrigin::kNone;
  }
  return false;
}

absl::Status CheckWays(const InputOrigins& origins, const std::string& where) {
  for (const OtherWay& way : kOtherWays) RETURN_IF_ERROR(CheckWay(way, origins, where));
  return absl::OkStatus();
}

absl::StatusOr<FixedCoordinates> CoordinatesOf(FixedInputs fixed) {
  if (fixed.any_sea && fixed[PulseInput::kBeamAzimuth].has_value()) fixed[PulseInput::kWindFrom] = kWindForNorth;
  InputOrigins origins;
  PulseNumbers numbers = {};
  for (std::size_t i = 0; i < kPulseInputCount; ++i) {
    const std::optional<float>& number = fixed[static_cast<PulseInput>(i)];
    origins[i] = number.has_value() ? InputOrigin::kFlag : InputOrigin::kNone;
    numbers[i] = number.value_or(0);
  }
  RETURN_IF_ERROR(CheckWays(origins, "pulse"));
  FixedCoordinates coordinates = fixed.coordinates;
  for (const AxisId axis : kAxes) {
    if (coordinates[Index(axis)].has_value()) continue;
    if (IsGivenByOtherWay(axis, origins)) {
      coordinates[Index(axis)] = FromOtherWay(axis, numbers);
    } else if (!MayBeAbsent(axis) && !(fixed.any_sea && IsOfSea(InputOf(axis)))) {
      return formats::UsageError(absl::StrCat("pulse: ", FlagName(axis), " is missing; give it in ",
                                              std::string(Describe(axis).units),
                                              axis == AxisId::kFootprint ? ", or --altitude and --divergence" : ""));
    }
  }
  return coordinates;
}

}  // namespace albtpu::annotate
