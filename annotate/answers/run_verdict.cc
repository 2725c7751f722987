#include "annotate/answers/run_verdict.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "tables/pulse.h"

namespace albtpu::annotate {
namespace {

using Spread = AnswerTally::Spread;

constexpr double kMetresPerFoot = 0.3048;                  // Exact: the international foot.
constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600;  // Exact: the international knot.
constexpr double kMetresPerSecondPerKmPerHour = 1 / 3.6;   // Exact.

// How the footprint is given.
enum class Given { kUnknown, kFootprint, kBeam };

// An input that may have been given in another unit, and the factor that corrects it.
struct WrongUnit {
  AxisId axis;
  Side side;
  Given given;
  double factor;
  const char* question;
  // The coordinate divided by the last node is at least this; nearer to the table, the coordinate is more likely
  // correct and the table too small.
  double min_excess = 1;
};

// With a full divergence of 1.5 mrad, 0.0015 mrad is a divergence in rad, 1500 mrad one in urad.
constexpr WrongUnit kWrongUnits[] = {
    {AxisId::kWindSpeed, Side::kAbove, Given::kUnknown, kMetresPerSecondPerKnot, "is the wind speed in knots?"},
    {AxisId::kWindSpeed, Side::kAbove, Given::kUnknown, kMetresPerSecondPerKmPerHour, "is the wind speed in km/h?"},
    {AxisId::kFetch, Side::kBelow, Given::kUnknown, 1000, "is the fetch in km?"},
    {AxisId::kIncidence, Side::kBelow, Given::kUnknown, 180 / std::numbers::pi, "is the incidence in rad?"},
    {AxisId::kFootprint, Side::kAbove, Given::kFootprint, 0.01, "is the footprint in cm?"},
    {AxisId::kFootprint, Side::kAbove, Given::kFootprint, 0.001, "is the footprint in mm?"},
    {AxisId::kFootprint, Side::kAbove, Given::kBeam, kMetresPerFoot, "is the altitude in feet?"},
    {AxisId::kFootprint, Side::kAbove, Given::kBeam, 0.001, "is the divergence in urad?"},
    {AxisId::kFootprint, Side::kBelow, Given::kBeam, 1000, "is the divergence in rad?"},
    {AxisId::kFootprint, Side::kBelow, Given::kFootprint, 1000, "is it the divergence, or the footprint in km?"},
    {AxisId::kDepth, Side::kBelow, Given::kUnknown, -1, "are depths negative downwards?"},
    {AxisId::kDepth, Side::kAbove, Given::kUnknown, 0.01, "is the depth in cm?", 3},
    {AxisId::kDepth, Side::kAbove, Given::kUnknown, 0.001, "is the depth in mm?", 3},
};

bool IsInside(AxisId axis, double coordinate, const TableAxes& axes) {
  const client::AxisRange& range = axes[Index(axis)];
  return coordinate >= range.first && (Describe(axis).is_endless || coordinate <= range.last);
}

std::string RangeText(double least, double greatest, std::string_view units) {
  const std::string end = least == greatest ? "" : absl::StrFormat(" to %g", greatest);
  return absl::StrFormat("%g%s %s", least, end, std::string(units));
}

// The input that the user gives, and its unit.
std::string GiveText(AxisId axis, Given given, Side side) {
  switch (axis) {
    case AxisId::kFootprint:
      if (given == Given::kBeam) return "give the altitude in m and the divergence in mrad, full angle";
      if (given == Given::kFootprint) return "give the footprint in m";
      return "give the footprint in m, or the altitude in m and the divergence in mrad, full angle";
    case AxisId::kDepth:
      if (side == Side::kBelow) return "give depths in m, positive below the surface";
      return "give depths in m";
    case AxisId::kIncidence:
      return "give the incidence in degrees from the vertical";
    case AxisId::kWindSpeed:
      return "give the wind speed in m/s";
    case AxisId::kFetch:
      return "give the fetch in m";
    case AxisId::kAzimuth:
      break;
  }
  return "choose a table that covers all azimuths";
}

// With one water level for all points, the wrong level that explains their median depth. Among several, the one whose
// correction gives the shallowest water: a wrong level is usually off by far more than the depth of the water.
std::string WaterLevelQuestion(double depth, const CauseContext& context) {
  const double level = context.water_level.value_or(0);
  const struct {
    double corrected_level;
    const char* question;
  } candidates[] = {{-level, "is the sign of --water-level wrong?"},
                    {level / 100, "is --water-level in cm?"},
                    {level / 1000, "is --water-level in mm?"},
                    {level * kMetresPerFoot, "is --water-level in feet?"}};
  std::string question;
  double shallowest = 0;
  for (const auto& candidate : candidates) {
    const double corrected = depth - level + candidate.corrected_level;
    if (!IsInside(AxisId::kDepth, corrected, context.axes)) continue;
    if (!question.empty() && corrected >= shallowest) continue;
    shallowest = corrected;
    question = candidate.question;
  }
  if (question.empty()) return "check --water-level and its vertical datum";
  return absl::StrFormat("%s corrected, the median depth would be %.3g m", question, shallowest);
}

std::string UnitQuestions(AxisId axis, Side side, Given given, double median, const CauseContext& context) {
  const client::AxisRange& range = context.axes[Index(axis)];
  std::vector<std::string> questions;
  for (const WrongUnit& wrong : kWrongUnits) {
    if (wrong.axis != axis || wrong.side != side) continue;
    const bool either_unknown = wrong.given == Given::kUnknown || given == Given::kUnknown;
    if (!either_unknown && wrong.given != given) continue;
    if (!IsInside(axis, median * wrong.factor, context.axes)) continue;
    if (wrong.min_excess > 1 && median < range.last * wrong.min_excess) continue;
    questions.emplace_back(wrong.question);
  }
  return absl::StrJoin(questions, " ");
}

LikelyCause OutOfDomain(AxisId axis, Side side, const Spread& spread, const CauseContext& context) {
  const AxisSchema& schema = Describe(axis);
  const client::AxisRange& range = context.axes[Index(axis)];
  const std::string units = axis == AxisId::kWindSpeed ? "m/s" : std::string(schema.units);
  LikelyCause cause;
  cause.why =
      absl::StrFormat("%s %s is %s %g %s, the %s node of the table", std::string(schema.name),
                      RangeText(spread.least, spread.greatest, units), std::string(Name(side)),
                      side == Side::kAbove ? range.last : range.first, units, side == Side::kAbove ? "last" : "first");
  if (axis == AxisId::kDepth && context.water_level.has_value()) {
    cause.suggestion = WaterLevelQuestion(spread.median, context);
    return cause;
  }
  const Given given = !context.footprint_from_beam.has_value() ? Given::kUnknown
                      : *context.footprint_from_beam           ? Given::kBeam
                                                               : Given::kFootprint;
  const std::string questions = UnitQuestions(axis, side, given, spread.median, context);
  if (!questions.empty())
    cause.suggestion = absl::StrCat(questions, " ", GiveText(axis, given, side));
  else if (axis == AxisId::kDepth && side == Side::kAbove)
    cause.suggestion = "the water is too deep for this table: check the water level, or use another table";
  else
    cause.suggestion = absl::StrCat(GiveText(axis, given, side), ", or use a table that covers it");
  return cause;
}

LikelyCause WithoutPulse(NoPulse why, const std::optional<Spread>& spread, const CauseContext& context) {
  switch (why) {
    case NoPulse::kNoTrajectory:
      return {"the trajectory has no position at their times",
              "check that it is of this flight, and that its times are GPS or UTC as --trajectory-time says"};
    case NoPulse::kUncertainTrajectory:
      return {"the position of the sensor is too uncertain from their returns", "give its --trajectory"};
    case NoPulse::kNoSurface:
      if (context.water_level_by_time) {
        return {"the file of --water-level has no level at their times",
                "check its times, which are UTC with a Z or GPS times in the form of the points, and give levels "
                "at most 2 hours apart from before the first point to after the last"};
      }
      return {"no water surface is known there",
              "check --water-classes, or give the height of the water by --water-level"};
    case NoPulse::kNoSea:
      return {"the file of the sea has no record near their times",
              "check that it is of these days, in UTC; choose one of its times by --sea-time, or bridge "
              "longer gaps by longest_gap in [sea] of a survey file"};
    case NoPulse::kNoChannel:
      return {"they are of scanners that the survey file does not have",
              "add their scanner_channels or user_data to [[sensor.channel]]"};
    case NoPulse::kAboveWater:
    case NoPulse::kDry:
      break;
  }
  LikelyCause cause{"they lie above the water surface", "check the water surface and its vertical datum"};
  if (spread.has_value()) {
    cause.why =
        absl::StrCat("they lie ", RangeText(-spread->greatest, -spread->least, "m"), " above the water surface");
    if (context.water_level.has_value()) cause.suggestion = WaterLevelQuestion(spread->median, context);
  }
  return cause;
}

constexpr double kRarelyAllDeeper = 20;  // m
constexpr double kAboveByWaves = 2;      // m; how far the shallowest point may seem above the right level.

}  // namespace

std::optional<LikelyCause> FindLikelyCause(const AnswerTally& tally, const CauseContext& context) {
  if (tally.without_number.empty()) return std::nullopt;
  const auto& [outcome, most] =
      *std::max_element(tally.without_number.begin(), tally.without_number.end(),
                        [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
  for (std::size_t i = 0; i < kNoPulseCount; ++i) {
    const auto why = static_cast<NoPulse>(i);
    if (outcome == OutcomeName(why)) return WithoutPulse(why, most.coordinate, context);
  }
  for (const AxisId axis : kAxes) {
    for (const Side side : {Side::kBelow, Side::kAbove}) {
      const std::string name =
          absl::StrCat("OUT_OF_DOMAIN:", std::string(Describe(axis).name), ":", std::string(Name(side)));
      if (outcome == name && most.coordinate.has_value()) return OutOfDomain(axis, side, *most.coordinate, context);
    }
  }
  if (outcome == "INVALID") return LikelyCause{"a coordinate is not a finite number", "correct the coordinates"};
  return LikelyCause{outcome, "check the coordinates against the axes that `albtpu-query tables` lists"};
}

std::string RunVerdict::Problem(const AnswerTally& tally) const {
  const std::string how_many = tally.interpolated == 0 ? absl::StrCat("no ", record_, " got a number")
                                                       : absl::StrCat("only ", tally.interpolated, " of ", tally.chosen,
                                                                      " ", record_, "s got a number");
  const std::string outcomes = absl::StrJoin(tally.without_number, ", ", [](std::string* text, const auto& outcome) {
    absl::StrAppend(text, outcome.second.count, " ", outcome.first);
  });
  const std::optional<LikelyCause> cause = FindLikelyCause(tally, context_);
  if (!cause.has_value()) return how_many;
  return absl::StrCat(how_many, " (", outcomes, ": ", cause->why, "); ", cause->suggestion);
}

std::string RunVerdict::Add(std::string_view file, const AnswerTally& answers) {
  all_.Merge(answers);
  ++files_;
  last_file_ = file;
  if (!answers.mostly_without_number()) return "";
  return absl::StrCat(std::string(file), ": ", Problem(answers));
}

std::optional<double> RunVerdict::MinDepthWithOtherSign() const {
  if (!all_.min_depth.has_value() || *all_.min_depth < kRarelyAllDeeper) return std::nullopt;
  const double corrected = *all_.min_depth - 2 * context_.water_level.value_or(0);
  if (corrected >= kRarelyAllDeeper || corrected < -kAboveByWaves) return std::nullopt;
  return corrected;
}

absl::Status RunVerdict::status() const {
  const std::string where = files_ == 1 ? last_file_ : absl::StrCat("in all ", files_, " files");
  if (all_.mostly_without_number()) return absl::FailedPreconditionError(absl::StrCat(where, ": ", Problem(all_)));
  const std::optional<double> corrected = MinDepthWithOtherSign();
  if (!corrected.has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrFormat(
      "%s: no %s is shallower than %g m (the least depth is %.1f m); is the sign of --water-level wrong? "
      "corrected, the least depth would be %.1f m",
      where, record_, kRarelyAllDeeper, *all_.min_depth, *corrected));
}

std::string RunVerdict::DeepNote() const {
  if (!all_.min_depth.has_value() || *all_.min_depth < kRarelyAllDeeper) return "";
  if (MinDepthWithOtherSign().has_value()) return "";  // status() says more.
  return absl::StrFormat(
      "no %s is shallower than %g m (the least depth is %.1f m); unless the survey is that deep, check the "
      "water level and its vertical datum",
      record_, kRarelyAllDeeper, *all_.min_depth);
}

}  // namespace albtpu::annotate
